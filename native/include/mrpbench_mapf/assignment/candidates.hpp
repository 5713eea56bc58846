// The goals that each robot may take, and its earliest arrival there without other robots.
#pragma once

#include <algorithm>
#include <vector>

#include "mrpbench_mapf/assignment/ranking.hpp"
#include "mrpbench_mapf/model/instance.hpp"

namespace mrpbench::mapf {

struct Candidates {
  std::vector<int> goal;                // by column: vertices in ascending order, those of all robots
  std::vector<std::vector<Tick>> cost;  // by robot and column: least arrival time, kForever = not to be
};

/// The goals of all robots without costs.
inline std::vector<int> all_goals(const Instance& instance) {
  std::vector<int> goals;
  for (const Robot& robot : instance.robots()) goals.insert(goals.end(), robot.goals.begin(), robot.goals.end());
  std::ranges::sort(goals);
  goals.erase(std::unique(goals.begin(), goals.end()), goals.end());
  return goals;
}

/// Calls `distance(robot, goal)` for the ticks from the end of the robot's beginning to the goal.
template <class Distance>
Candidates list_candidates(const Instance& instance, Limits& limits, Distance distance) {
  Candidates found{all_goals(instance), {}};
  limits.charge(instance.size() * found.goal.size() * sizeof(Tick));
  for (int robot = 0; robot < instance.size(); ++robot) {
    const Beginning& beginning = instance.beginning(robot);
    std::vector<Tick>& row = found.cost.emplace_back(found.goal.size(), kForever);
    for (const int goal : instance.robots()[robot].goals) {
      limits.check();
      const Tick ticks = distance(robot, goal);
      if (ticks == kForever) continue;
      const auto column = std::ranges::lower_bound(found.goal, goal) - found.goal.begin();
      row[column] = ticks == 0 ? enter_tick(beginning.occupied.back()) : beginning.free_at + ticks;
    }
  }
  return found;
}

/// Goals for all robots, the cheapest first.
class RankedGoals {
 public:
  RankedGoals(Candidates candidates, Limits& limits)
      : goal_(std::move(candidates.goal)), ranking_(std::move(candidates.cost), limits) {}

  struct Ranked {
    Cost cost;
    std::vector<int> goals;  // by robot
  };
  std::optional<Ranked> next() {
    auto ranked = ranking_.next();
    if (!ranked) return std::nullopt;
    Ranked result{ranked->cost, {}};
    for (const std::int32_t column : ranked->column_of) result.goals.push_back(goal_[column]);
    return result;
  }

 private:
  std::vector<int> goal_;
  Ranking ranking_;
};

}  // namespace mrpbench::mapf
