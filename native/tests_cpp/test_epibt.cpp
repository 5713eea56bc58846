// EPIBT by its planner alone: who makes room for whom.
#include <algorithm>
#include <vector>

#include "check.hpp"
#include "mrpbench_discrete/planner.hpp"

using namespace mrpbench::discrete;

namespace {

/// Plan and execute so many steps.
void run(View& view, int steps, const PlannerOptions& options = {"epibt", 4, false}, int iterations = 0) {
  const auto planner = make_planner(options, 0);
  std::vector<Action> action;
  for (int step = 0; step < steps; ++step) {
    planner->plan(view, {1, iterations}, action);
    for (std::size_t i = 0; i < action.size(); ++i) view.pose[i] = view.grid.after(view.pose[i], action[i]);
  }
}

}  // namespace

/// In a corridor, robots without a goal face the one that comes, so that they have to turn round before they leave.
TEST("robots that have to turn first make room") {
  const std::vector<std::uint8_t> blocked(6, 0);
  const Grid grid(blocked, 1, 6);
  DistanceTables tables(grid, 1 << 20);
  View view{grid, tables};
  view.pose = {{0, 0}, {1, 2}, {2, 2}};
  view.goal = {3, -1, -1};
  view.next_goal = {-1, -1, -1};
  view.rest = {0, 0, 0};
  run(view, 8);
  CHECK(view.pose[0].cell == 3);
  CHECK(view.pose[1].cell == 4);
  CHECK(view.pose[2].cell == 5);
}

TEST("results do not depend on the number of threads, and improvement changes them") {
  const std::vector<std::uint8_t> blocked(100, 0);
  const Grid grid(blocked, 10, 10);
  DistanceTables tables(grid, 1 << 20);
  const auto after = [&](int threads, int iterations) {
    View view{grid, tables};
    for (int i = 0; i < 60; ++i) {
      view.pose.push_back({i, i % 4});
      view.goal.push_back(99 - (7 * i) % 100);
      view.next_goal.push_back(i);
      view.rest.push_back(0);
    }
    run(view, 6, {"epibt", 4, true, threads}, iterations);
    return view.pose;
  };
  const auto one = after(1, 300);
  CHECK(one == after(2, 300));
  CHECK(one == after(7, 300));
  CHECK(one != after(1, 0));
}
