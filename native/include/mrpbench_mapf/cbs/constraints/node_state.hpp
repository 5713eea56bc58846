// Paths and constraints of the robots in one node of a constraint tree.
#pragma once

#include "mrpbench_mapf/cbs/constraints/constraint_table.hpp"
#include "mrpbench_mapf/cbs/constraints/key.hpp"
#include "mrpbench_mapf/cbs/constraints/timed_path.hpp"

namespace mrpbench::mapf {

class NodeState {
 public:
  explicit NodeState(int robots) : paths_(robots), least_(robots), constraints_(robots), keys_(robots) {}

  void clear_constraints() {
    for (const int robot : bound_) constraints_[robot].clear();
    for (const int robot : bound_) keys_[robot] = {};
    bound_.clear();
    parked_.clear();
    parked_key_ = {};
  }
  void add(const Constraint& constraint) {
    std::vector<Constraint>& own = constraints_[constraint.robot];
    if (own.empty()) bound_.push_back(constraint.robot);
    own.push_back(constraint);
    const Key key = key_of(constraint);
    keys_[constraint.robot] += key;
    if (constraint.kind != Constraint::Kind::length_at_most) return;
    parked_.push_back(constraint);
    parked_key_ += key;
  }
  /// `least`: no path of `robot` under what binds it costs less.
  void set_path(int robot, const TimedPath& path, Tick least) {
    paths_[robot] = path;
    least_[robot] = least;
  }
  void set_path(int robot, const TimedPath& path) { set_path(robot, path, path.cost); }

  const TimedPath& path(int robot) const { return paths_[robot]; }
  Tick least(int robot) const { return least_[robot]; }
  std::span<const Constraint> constraints(int robot) const { return constraints_[robot]; }
  /// The `length_at_most` of all robots, which bind all the others.
  std::span<const Constraint> parked() const { return parked_; }
  /// Names all that binds `robot`.
  Key key(int robot) const {
    Key key = keys_[robot];
    if (paths_[robot].goal != TimedPath::kAnyGoal) key += key_of_goal(paths_[robot].goal);
    return key += parked_key_;
  }
  /// Reset `table` for `robot` and add all that binds it, on its way to the goal of its path, or to `goal`.
  void load(int robot, ConstraintTable& table) const { load(robot, paths_[robot].goal, table); }
  void load(int robot, int goal, ConstraintTable& table) const {
    table.reset(robot, goal);
    table.add(constraints_[robot]);
    for (const Constraint& constraint : parked_) {
      if (constraint.robot != robot) table.add(constraint);
    }
  }

 private:
  std::vector<TimedPath> paths_;
  std::vector<Tick> least_;                           // by robot
  std::vector<std::vector<Constraint>> constraints_;  // by robot
  std::vector<Key> keys_;                             // by robot
  std::vector<int> bound_;                            // robots with constraints
  std::vector<Constraint> parked_;
  Key parked_key_;
};

}  // namespace mrpbench::mapf
