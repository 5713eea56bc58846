#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/algorithms/astar.hpp"
#include "mrpbench_mapf/algorithms/cbs.hpp"
#include "mrpbench_mapf/algorithms/prioritized.hpp"
#include "mrpbench_mapf/infeasibility/solvability.hpp"

using namespace mrpbench::mapf;

namespace {

Result cbs(const Instance& it) {
  Limits limits = unlimited();
  return solve_cbs(it, {}, limits);
}

Result prioritized(const Instance& it, PrioritizedOptions options = {}) {
  Limits limits = unlimited();
  return solve_prioritized(it, options, limits);
}

}  // namespace

TEST("two robots swap ends where there is a place to pass") {
  const Instance it = instance(grid(3, 2), {robot(0, 2), robot(2, 0)});
  const Result result = cbs(it);
  CHECK(result.status == Status::solved);
  CHECK(sum_of_costs(result) == 6);
  CHECK(result.lower_bound == 6.0);
  CHECK(prioritized(it).status == Status::solved);
}

TEST("every heuristic gives shortest paths") {
  const Instance it = instance(grid(5, 4, 3), {robot(0, 19), robot(19, 0)});
  for (const Heuristic heuristic :
       {Heuristic::exact, Heuristic::zero, Heuristic::manhattan, Heuristic::octile, Heuristic::euclidean}) {
    Limits limits = unlimited();
    const Result result = solve_astar(it, {heuristic}, limits);
    CHECK(result.status == Status::solved);
    CHECK(result.lower_bound == 42.0);
    CHECK(sum_of_costs(result) == 42);
  }
}

TEST("unsolvable instances are detected at once") {
  CHECK(cbs(instance(Roadmap(2, {0}, {1}, {1}), {robot(1, 0)})).status == Status::unsolvable);
  CHECK(cbs(instance(grid(3, 1), {robot(0, 1), robot(2, 1)})).status == Status::unsolvable);
  CHECK(cbs(instance(grid(3, 1), {robot(0, 1), robot(0, 2)})).status == Status::unsolvable);
  CHECK(cbs(instance(grid(900, 1), {robot(0, 9), robot(9, 0)})).status == Status::unsolvable);
  CHECK(prioritized(instance(grid(3, 1), {robot(0, 1), robot(2, 1)})).status == Status::unsolvable);
  std::vector<Robot> crowd{robot(0, 1), robot(2, 1), robot(4, 1)};
  for (Robot& it : crowd) it.goals = {1, 3};
  const Result result = cbs(instance(grid(5, 1), crowd));
  CHECK(result.status == Status::unsolvable);
  CHECK(result.statistics.failed_robot == 2);
}

TEST("a shared goal is fine where robots disappear") {
  const Rules disappear{.following_forbidden = false, .disappear_at_goal = true};
  const Result result = cbs(instance(grid(3, 1), {robot(0, 1), robot(2, 1)}, disappear));
  CHECK(result.status == Status::solved);
  CHECK(sum_of_costs(result) == 3);
}

TEST("an endless search stops at its limits and keeps its lower bound") {
  const Instance swap = instance(grid(2, 1, 2), {robot(0, 1), robot(1, 0)});
  const CbsOptions plain{.heuristic = false, .target = false, .corridor = false};
  Limits soon(0.05, 1LL << 40);
  const Result late = solve_cbs(swap, plain, soon);
  CHECK(late.status == Status::timeout);
  CHECK(late.lower_bound >= 6.0);
  Limits small(10.0, 4 << 20);
  CHECK(solve_cbs(swap, plain, small).status == Status::out_of_memory);
  Limits none(0.0, 1 << 20);
  CHECK(solve_cbs(instance(grid(200, 200), {robot(0, 39999)}), {}, none).status != Status::solved);
}

TEST("after a priority order that fails, others are tried up to the limit") {
  // Robot 0 would park in the corridor through which robot 1 has to pass.
  const Instance it = instance(grid(4, 1, 2), {robot(1, 2), robot(0, 3)});
  const Result one = prioritized(it, {.order = Order::index, .restarts = 0, .seed = 0});
  CHECK(one.status == Status::gave_up);
  CHECK(one.statistics.failed_robot == 1);
  const Result more = prioritized(it, {.order = Order::index, .restarts = 3, .seed = 0});
  CHECK(more.status == Status::gave_up);
  CHECK(more.statistics.restarts == 3);
  // In a bay it can wait until robot 1 has passed.
  const Instance bay = instance(Roadmap(5, {0, 1, 2, 1, 4, 3, 2, 1}, {1, 2, 3, 4, 1, 2, 1, 0}, std::vector<Tick>(8, 1)),
                                {robot(1, 2), robot(0, 3)});
  CHECK(prioritized(bay, {.order = Order::index, .restarts = 0, .seed = 0}).status == Status::gave_up);
  const Result solved = prioritized(bay, {.order = Order::index, .restarts = 1, .seed = 0});
  CHECK(solved.status == Status::solved);
  CHECK(solved.statistics.restarts == 1);
}
