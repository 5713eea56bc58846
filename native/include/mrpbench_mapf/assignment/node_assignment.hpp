// The assignment in a node of a constraint tree: the cheapest one assignment under the constraints of the node,
// from that of its parent. Costs are lower bounds until a path is planned; a path that costs more changes the
// assignment.
//   Tang, Ren, Li and Sycara, "Solving multi-agent target assignment and path finding with a single constraint tree",
//     MRS 2023. There the costs of a robot to all its goals are planned for every constraint; here only those of
//     goals that are assigned to it.
#pragma once

#include "mrpbench_mapf/assignment/candidates.hpp"
#include "mrpbench_mapf/common/arena.hpp"

namespace mrpbench::mapf {

class NodeAssignment {
 public:
  NodeAssignment(Candidates candidates, Limits& limits);

  /// What a node keeps, apart from the goals themselves.
  struct Record {
    std::span<const Tick* const> cost;  // by robot: a row of lower bounds
    std::span<const Cost> row_price, column_price;
    Cost idle_price;
  };

  /// The first assignment. False if there is none.
  bool solve();
  int goal(int robot) const { return candidates_.goal[present_.column_of[robot]]; }
  /// Lower bound on the cost of a path of `robot` to its goal.
  Tick bound(int robot) const { return cost_[robot][present_.column_of[robot]]; }
  /// The same on the cost of all solutions.
  Cost sum() const;
  /// No path of `robot` to its goal costs less than `cost`, kForever = there is none. Calls `changed(robot)` for robots
  /// that get other goals by that. False if no assignment is left.
  template <class Changed>
  bool raise(int robot, Tick cost, Changed changed) {
    if (cost <= cost_[robot][present_.column_of[robot]]) return true;
    before_ = present_.column_of;
    if (!raise(robot, cost)) return false;
    for (int other = 0; other < static_cast<int>(before_.size()); ++other) {
      if (present_.column_of[other] != before_[other]) changed(other);
    }
    return true;
  }
  const Record* keep();
  /// Restore the assignment of a node; `goal(robot)` are its goals.
  template <class Goal>
  void restore(const Record& record, Goal goal) {
    copy(record);
    for (int robot = 0; robot < static_cast<int>(cost_.size()); ++robot) send(robot, goal(robot));
  }
  /// How often goals were changed.
  std::int64_t changes() const { return changes_; }

 private:
  bool raise(int robot, Tick cost);
  void copy(const Record& record);
  void send(int robot, int goal);

  const Candidates candidates_;
  std::vector<std::int32_t> column_;  // by vertex
  Hungarian hungarian_;
  Arena<Tick> rows_;
  Arena<const Tick*> row_lists_;
  Arena<Cost> prices_;
  Arena<Record> records_;
  std::vector<const Tick*> cost_;  // by robot
  Assignment present_;
  std::vector<std::int32_t> before_;
  std::vector<Tick> row_;
  std::int64_t changes_ = 0;
};

}  // namespace mrpbench::mapf
