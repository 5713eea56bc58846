// EPIBT by its planner alone: who makes room for whom.
#include <vector>

#include "check.hpp"
#include "mrpbench_discrete/planner.hpp"

using namespace mrpbench::discrete;

namespace {

/// Plan and execute so many steps.
void run(View& view, int steps) {
  const auto planner = make_planner({"epibt", 4, false}, 0);
  std::vector<Action> action;
  for (int step = 0; step < steps; ++step) {
    planner->plan(view, {1, 0}, action);
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
