#include <algorithm>
#include <set>

#include "check.hpp"
#include "mrpbench_mapf/algorithms/cbs.hpp"
#include "plans.hpp"

using namespace mrpbench::mapf;

namespace {

constexpr double kW = 1.2;

Result optimal(const Instance& it, GoalChoice goals) {
  Limits limits(0.2, 1LL << 30);
  return solve_cbs(it, {.goals = goals}, limits);
}

Result bounded(const Instance& it, GoalChoice goals, Selection selection) {
  Limits limits(0.2, 1LL << 30);
  return solve_cbs(it, {.goals = goals, .selection = selection, .w = kW}, limits);
}

/// Robots that may take any of the goals of all, and of one more vertex, on a grid with holes; lanes take `longest`
/// ticks at most.
Instance anonymous(Random& random, int robots, int longest) {
  const Instance drawn = random_instance(random, 4, 3, robots);
  const Roadmap& road = drawn.roadmap();
  std::vector<int> tail, head;
  std::vector<Tick> duration;
  for (int edge = 0; edge < road.edge_count(); ++edge) {
    tail.push_back(road.tail(edge));
    head.push_back(road.head(edge));
    duration.push_back(1 + static_cast<Tick>(random.below(longest)));
  }
  std::set<int> goals{static_cast<int>(random.below(road.vertex_count()))};
  for (const Robot& it : drawn.robots()) goals.insert(it.goals.front());
  std::vector<Robot> all = drawn.robots();
  for (Robot& it : all) it.goals.assign(goals.begin(), goals.end());
  return instance(Roadmap(road.vertex_count(), tail, head, duration), all);
}

/// The least cost over all assignments, each solved on its own; -1 if one is not solved in time.
Cost by_enumeration(const Instance& it) {
  std::vector<int> order = it.robots().front().goals;
  std::set<std::vector<int>> seen;
  Cost best = kForever;
  do {
    const std::vector<int> chosen(order.begin(), order.begin() + it.size());
    if (!seen.insert(chosen).second) continue;
    std::vector<Robot> robots = it.robots();
    for (int robot = 0; robot < it.size(); ++robot) robots[robot].goals = {chosen[robot]};
    const Result result = optimal(instance(it.roadmap(), robots), GoalChoice::own);
    if (result.status == Status::timeout && result.lower_bound < static_cast<double>(best)) return -1;
    if (result.status == Status::solved) best = std::min(best, sum_of_costs(result));
  } while (std::ranges::next_permutation(order).found);
  return best;
}

}  // namespace

TEST("no assignment is cheaper, with one tree per assignment or a single tree, optimal or within the bound") {
  Random random(7);
  int compared = 0;
  for (int round = 0; round < 60; ++round) {
    const Instance it = anonymous(random, 2 + round % 2, round % 3 == 0 ? 3 : 1);
    const Cost best = by_enumeration(it);
    if (best < 0 || best == kForever) continue;
    ++compared;
    for (const GoalChoice goals : {GoalChoice::ranked, GoalChoice::by_node}) {
      const Result least = optimal(it, goals);
      CHECK(least.status == Status::solved);
      CHECK(faults(it, least) == 0);
      CHECK(sum_of_costs(least) == best);
      for (const Selection selection : {Selection::focal, Selection::explicit_estimation}) {
        const Result result = bounded(it, goals, selection);
        CHECK(result.status == Status::solved);
        CHECK(faults(it, result) == 0);
        CHECK(result.lower_bound <= static_cast<double>(best));
        CHECK(static_cast<double>(sum_of_costs(result)) <= kW * result.lower_bound);
      }
    }
  }
  CHECK(compared > 30);
}

TEST("a robot that may take any goal does not wait for another one's goal") {
  // The one that has arrived stays in the way; it is cheaper to go on to the other goal.
  const Roadmap line = grid(6, 1);
  std::vector<Robot> robots{robot(0, 3), robot(1, 3)};
  for (Robot& it : robots) it.goals = {3, 5};
  const Instance it = instance(line, robots);
  for (const GoalChoice goals : {GoalChoice::ranked, GoalChoice::by_node}) {
    const Result result = optimal(it, goals);
    CHECK(sum_of_costs(result) == 7);
    CHECK(result.paths[0].back().element == 3);
    CHECK(result.statistics.assignments >= 1);
  }
}
