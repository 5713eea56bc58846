#include <numeric>
#include <set>

#include "check.hpp"
#include "mrpbench_mapf/algorithms/cbs.hpp"
#include "mrpbench_mapf/algorithms/lacam.hpp"
#include "mrpbench_mapf/algorithms/lns.hpp"
#include "mrpbench_mapf/algorithms/pibt.hpp"
#include "plans.hpp"

using namespace mrpbench::mapf;

namespace {

Result lacam(const Instance& it, LacamOptions options = {}) {
  Limits limits = unlimited();
  return solve_lacam(it, options, limits);
}

Result pibt(const Instance& it, PibtOptions options = {}) {
  Limits limits = unlimited();
  return solve_pibt(it, options, limits);
}

/// The same, but edges take up to four ticks, and one that a robot is on excludes what it shares an end with.
Instance with_footprints(Random& random, const Instance& unit) {
  const Roadmap& road = unit.roadmap();
  std::vector<int> tail, head;
  std::vector<Tick> duration;
  for (int edge = 0; edge < road.edge_count(); ++edge) {
    tail.push_back(road.tail(edge));
    head.push_back(road.head(edge));
    duration.push_back(1 + random.below(4));
  }
  const auto ends = [&](int element) {
    if (element < road.vertex_count()) return std::pair(element, element);
    return std::pair(tail[element - road.vertex_count()], head[element - road.vertex_count()]);
  };
  Exclusions exclusions{{0}, {}, {}};
  for (int one = 0; one < road.element_count(); ++one) {
    for (int other = 0; other < road.element_count(); ++other) {
      const auto [a, b] = ends(one);
      const auto [c, d] = ends(other);
      if (a != c && a != d && b != c && b != d) continue;
      exclusions.element.push_back(other);
      exclusions.distance.push_back(0.0);
    }
    exclusions.first.push_back(static_cast<std::int64_t>(exclusions.element.size()));
  }
  std::vector<Robot> robots = unit.robots();
  for (Robot& it : robots) it.radius = 0.3;
  return Instance(Roadmap(road.vertex_count(), tail, head, duration), robots, {}, exclusions);
}

/// By moves of one robot at a time to a free vertex, as footprints of edges that share an end allow no others.
bool can_be_rearranged(const Instance& it) {
  std::vector<int> start, goal;
  for (const Robot& robot : it.robots()) {
    start.push_back(robot.start);
    goal.push_back(robot.goals.front());
  }
  std::set<std::vector<int>> seen{start};
  std::vector<std::vector<int>> queue{start};
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::vector<int> at = queue[next];
    if (at == goal) return true;
    for (std::size_t robot = 0; robot < at.size(); ++robot) {
      for (const int edge : it.roadmap().out(at[robot])) {
        std::vector<int> to = at;
        to[robot] = it.roadmap().head(edge);
        if (std::ranges::count(at, to[robot]) == 0 && seen.insert(to).second) queue.push_back(to);
      }
    }
  }
  return false;
}

}  // namespace

TEST("it finds a plan exactly where there is one, and ends with the best") {
  Random random(1);
  int unsolvable = 0;
  for (int k = 0; k < 300; ++k) {
    const Instance it = random_instance(random, 3, 3, 2 + random.below(2));
    const Cost makespan = least_makespan(it);
    const Result shortest = lacam(it, {.objective = Objective::makespan, .iterations = {}, .seed = 7});
    const Result cheapest = lacam(it);
    unsolvable += makespan < 0;
    CHECK((shortest.status == Status::solved) == (makespan >= 0));
    CHECK(shortest.status == Status::solved || shortest.status == Status::unsolvable);
    CHECK(cheapest.status == shortest.status);
    if (makespan < 0) continue;
    CHECK(faults(it, shortest) == 0);
    CHECK(faults(it, cheapest) == 0);
    CHECK(value(Objective::makespan, shortest.paths).first == makespan);
    Limits limits = unlimited();
    CHECK(sum_of_costs(cheapest) == sum_of_costs(solve_cbs(it, {}, limits)));
    CHECK(cheapest.lower_bound == static_cast<double>(sum_of_costs(cheapest)));
    CHECK(!cheapest.clock_bound);
  }
  CHECK(unsolvable > 10);
}

TEST("the search alone proves what needs every configuration") {
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    const Instance it = random_instance(random, 4, 2, 4);
    const Result alone = lacam(it, {.neighbourhoods = false, .iterations = {}});
    const Result both = lacam(it);
    CHECK(alone.status == both.status);
    if (alone.status == Status::solved) CHECK(sum_of_costs(alone) == sum_of_costs(both));
  }
}

TEST("crowds are planned, and iterations only make plans better") {
  Random random(3);
  for (int k = 0; k < 20; ++k) {
    const Instance it = random_instance(random, 9, 9, 25);
    const Result first = lacam(it, {.iterations = 0});
    const Result later = lacam(it, {.iterations = 200});
    CHECK(first.status == later.status);
    if (first.status != Status::solved) continue;
    CHECK(faults(it, first) == 0);
    CHECK(faults(it, later) == 0);
    CHECK(sum_of_costs(later) <= sum_of_costs(first));
    CHECK(static_cast<double>(sum_of_costs(later)) >= later.lower_bound);
    CHECK(later.history.front().cost == static_cast<double>(sum_of_costs(first)));
    CHECK(later.history.back().cost == static_cast<double>(sum_of_costs(later)));
    CHECK(lacam(it, {.iterations = 200}).paths == later.paths);
  }
}

TEST("a swap in a dead end is unsolvable without a limit") {
  CHECK(lacam(instance(grid(5, 1), {robot(0, 4), robot(4, 0)})).status == Status::unsolvable);
  CHECK(lacam(instance(grid(2, 1), {robot(0, 1), robot(1, 0)})).status == Status::unsolvable);
  CHECK(lacam(instance(grid(3, 1), {robot(0, 1), robot(2, 1)})).status == Status::unsolvable);
  CHECK(lacam(instance(grid(3, 1), {})).status == Status::solved);
}

TEST("one-way lanes that lead in circles end as well") {
  // A path into a ring that no robot leaves.
  const auto ring = [] { return Roadmap(4, {0, 1, 2, 3}, {1, 2, 3, 1}, std::vector<Tick>(4, 1)); };
  CHECK(lacam(instance(ring(), {robot(0, 3), robot(1, 2)})).status == Status::solved);
  CHECK(lacam(instance(ring(), {robot(2, 3), robot(3, 2)})).status == Status::solved);
  CHECK(lacam(instance(ring(), {robot(1, 2), robot(2, 1), robot(3, 3)})).status == Status::unsolvable);
}

TEST("a plan along ways that keep clear of one another is no worse, and mostly better") {
  Random random(5);
  int better = 0, all = 0;
  for (int k = 0; k < 20; ++k) {
    const Instance it = random_instance(random, 14, 10, 30);
    const Result first = lacam(it, {.iterations = 0});
    if (first.status != Status::solved) continue;
    const Result second = lacam(it, {.prioritized = false, .star = false, .neighbourhoods = false, .iterations = 1});
    CHECK(faults(it, second) == 0);
    CHECK(sum_of_costs(second) <= sum_of_costs(first));
    ++all;
    better += sum_of_costs(second) < sum_of_costs(first);
  }
  CHECK(all > 5 && 2 * better > all);
}

TEST("in a crowd further plans are drawn, and the best of all is kept") {
  Random random(8);
  int better = 0, crowded = 0;
  for (int k = 0; k < 10; ++k) {
    std::vector<int> starts(48), goals(48);
    std::iota(starts.begin(), starts.end(), 0);
    std::iota(goals.begin(), goals.end(), 0);
    random.shuffle(starts);
    random.shuffle(goals);
    std::vector<Robot> robots;
    for (int i = 0; i < 40; ++i) robots.push_back(robot(starts[i], goals[i]));
    const Instance it = instance(grid(16, 3), robots);
    const Result first = lacam(it, {.iterations = 0});
    if (static_cast<double>(sum_of_costs(first)) < 4 * first.history.back().lower_bound) continue;
    const LacamOptions options{.prioritized = false, .star = false, .neighbourhoods = false, .iterations = 1};
    const Result best = lacam(it, options);
    CHECK(faults(it, best) == 0);
    CHECK(sum_of_costs(best) <= sum_of_costs(first));
    CHECK(lacam(it, options).paths == best.paths);
    ++crowded;
    better += sum_of_costs(best) < sum_of_costs(first);
  }
  CHECK(crowded > 5 && better > crowded / 2);
}

TEST("where there is room, robots planned in turn are hardly later than alone") {
  Random random(6);
  int close = 0, all = 0;
  for (int k = 0; k < 10; ++k) {
    const Instance it = random_instance(random, 30, 30, 40);
    const Result first = lacam(it, {.iterations = 0});
    if (first.status != Status::solved) continue;  // a robot in a closed corner
    const Result second = lacam(it, {.guides = false, .star = false, .neighbourhoods = false, .iterations = 1});
    CHECK(faults(it, second) == 0);
    close += static_cast<double>(sum_of_costs(second)) < 1.05 * second.lower_bound;
    ++all;
    const Result repaired = [&] {
      Limits limits = unlimited();
      return solve_lns(it, {.initial = Initial::repair, .iterations = 1000}, limits);
    }();
    CHECK(repaired.status == Status::solved && faults(it, repaired) == 0);
  }
  CHECK(all > 5 && 4 * close > 3 * all);
}

TEST("priority inheritance plans crowds in the open, or gives up") {
  Random random(4);
  int solved = 0;
  for (int k = 0; k < 50; ++k) {
    const Instance it = random_instance(random, 10, 10, 20);
    const Result result = pibt(it, {.steps = 500, .seed = 1});
    CHECK(result.status != Status::timeout);
    if (result.status != Status::solved) continue;
    ++solved;
    CHECK(faults(it, result) == 0);
  }
  CHECK(solved > 10);
  CHECK(pibt(instance(grid(4, 1), {robot(0, 3)}), {.steps = 2}).status == Status::gave_up);
}

TEST("limits hold, and a plan that was found is kept") {
  std::vector<Robot> crowd;
  for (int k = 0; k < 60; ++k) crowd.push_back(robot(k, 143 - k));
  const Instance it = instance(grid(12, 12), crowd);
  Limits soon(0.5, 1LL << 40);
  const Result late = solve_lacam(it, {}, soon);
  CHECK(late.status == Status::solved && late.clock_bound);
  CHECK(faults(it, late) == 0);
  Limits none(0.0, 1LL << 40);
  CHECK(solve_lacam(it, {}, none).status == Status::timeout);
  Limits tiny(10.0, 1 << 16);
  CHECK(solve_lacam(it, {}, tiny).status == Status::out_of_memory);
}

TEST("moves of several ticks are planned exactly where robots with footprints can be rearranged") {
  Random random(9);
  int solved = 0, unsolvable = 0;
  for (int k = 0; k < 200; ++k) {
    const Instance unit = random_instance(random, 3, 3, 2 + random.below(2));
    const Instance slow = with_footprints(random, unit);
    const Result result = lacam(slow, {.iterations = 20});
    CHECK(faults(slow, result) == 0 || result.status != Status::solved);
    CHECK(result.status == Status::solved || result.status == Status::unsolvable);
    CHECK((result.status == Status::solved) == can_be_rearranged(slow));
    solved += result.status == Status::solved;
    unsolvable += result.status == Status::unsolvable;
    const Result other = pibt(slow, {.seed = 3});
    if (other.status == Status::solved) CHECK(faults(slow, other) == 0);
  }
  CHECK(solved > 50 && unsolvable > 10);
}

TEST("robots with a choice of goals, or that disappear there, are refused") {
  Robot choosy = robot(0, 2);
  choosy.goals = {1, 2};
  Limits limits = unlimited();
  const Instance choice = instance(grid(3, 1), {choosy});
  const Instance vanishing = instance(grid(3, 1), {robot(0, 2)}, {.disappear_at_goal = true});
  CHECK(check::throws<std::invalid_argument>([&] { solve_lacam(choice, {}, limits); }));
  CHECK(check::throws<std::invalid_argument>([&] { solve_pibt(vanishing, {}, limits); }));
}
