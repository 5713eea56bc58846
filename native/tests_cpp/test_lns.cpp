#include "check.hpp"
#include "mrpbench_mapf/algorithms/lacam.hpp"
#include "mrpbench_mapf/algorithms/lns.hpp"
#include "mrpbench_mapf/algorithms/pbs.hpp"
#include "plans.hpp"

using namespace mrpbench::mapf;

namespace {

Result lns(const Instance& it, LnsOptions options) {
  Limits limits = unlimited();
  return solve_lns(it, options, limits);
}

}  // namespace

TEST("plans have no conflicts and cost no less than the optimum") {
  Random random(1);
  int solved = 0;
  for (int k = 0; k < 60; ++k) {
    const Instance it = random_instance(random, 3, 3, 3);
    const Cost makespan = least_makespan(it);
    Limits limits = unlimited();
    const Cost best = sum_of_costs(solve_lacam(it, {}, limits));
    for (const Initial initial : {Initial::repair, Initial::lacam, Initial::either}) {
      const Result result = lns(it, {.initial = initial, .iterations = 50});
      if (initial != Initial::repair) CHECK((result.status == Status::solved) == (makespan >= 0));
      if (result.status != Status::solved) continue;
      ++solved;
      CHECK(faults(it, result) == 0);
      CHECK(sum_of_costs(result) >= best);
    }
  }
  CHECK(solved > 90);
}

TEST("iterations only make plans better, and repeat themselves") {
  Random random(2);
  for (int k = 0; k < 10; ++k) {
    const Instance it = random_instance(random, 10, 10, 30);
    for (const Objective objective : {Objective::flowtime, Objective::makespan}) {
      const Result first = lns(it, {.objective = objective, .iterations = 100});
      const Result later = lns(it, {.objective = objective, .iterations = 300});
      CHECK(first.status == later.status);
      if (first.status != Status::solved) continue;
      CHECK(faults(it, later) == 0);
      CHECK(value(objective, later.paths) <= value(objective, first.paths));
      CHECK(lns(it, {.objective = objective, .iterations = 300}).paths == later.paths);
    }
  }
}

TEST("long edges, footprints, commitments and rules are kept") {
  Random random(3);
  int solved = 0;
  for (int k = 0; k < 60; ++k) {
    std::vector<Robot> robots;
    for (const auto& [start, goal] : {std::pair(0, 23), {5, 18}, {20, 3}, {12, 10}})
      robots.push_back(robot(start, goal));
    robots[1].ready = random.below(4);
    robots[2].goals = {3, 8};
    const Rules rules{.following_forbidden = random.below(2) == 0, .disappear_at_goal = random.below(2) == 0};
    const Roadmap roadmap = grid(6, 4, 1 + random.below(3));
    if (random.below(2) == 0) {
      const int edge = roadmap.out(12)[random.below(roadmap.out(12).size())];
      robots[3].committed = {{-1, 0, 2}, {edge, 2, 7}};
    }
    const Instance it = instance(roadmap, robots, rules);
    const Result result = lns(it, {.iterations = 40, .seed = static_cast<std::uint64_t>(k)});
    if (result.status != Status::solved) continue;
    ++solved;
    CHECK(faults(it, result) == 0);
    Limits limits = unlimited();
    const Result pbs = solve_pbs(it, {}, limits);
    CHECK(pbs.status == Status::solved && faults(it, pbs) == 0);
  }
  CHECK(solved > 40);
}

TEST("priorities that are found out plan what fixed ones do not, or it gives up") {
  Random random(4);
  int solved = 0;
  for (int k = 0; k < 200; ++k) {
    const Instance it = random_instance(random, 4, 3, 4);
    Limits limits = unlimited();
    const Result result = solve_pbs(it, {}, limits);
    CHECK(result.status != Status::unsolvable || least_makespan(it) < 0);
    CHECK((result.statistics.failed_robot < 0) == (result.status == Status::solved));
    if (result.status != Status::solved) continue;
    ++solved;
    CHECK(faults(it, result) == 0);
    CHECK(static_cast<double>(sum_of_costs(result)) >= result.lower_bound);
  }
  CHECK(solved > 80);
}

TEST("limits hold, and a plan that was found is kept") {
  std::vector<Robot> crowd;
  for (int k = 0; k < 60; ++k) crowd.push_back(robot(k, 143 - k));
  const Instance it = instance(grid(12, 12), crowd);
  Limits soon(0.5, 1LL << 40);
  const Result late = solve_lns(it, {.initial = Initial::lacam, .iterations = {}}, soon);
  CHECK(late.status == Status::solved && late.clock_bound);
  CHECK(faults(it, late) == 0);
  Limits none(0.0, 1LL << 40);
  CHECK(solve_lns(it, {}, none).status == Status::timeout);
  Limits tiny(10.0, 1 << 16);
  CHECK(solve_lns(it, {}, tiny).status == Status::out_of_memory);
  Limits tiny_too(10.0, 1 << 16);
  CHECK(solve_pbs(it, {}, tiny_too).status == Status::out_of_memory);
}
