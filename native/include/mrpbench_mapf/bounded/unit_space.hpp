// Planning for single robots on roadmaps of unit moves, as `BoundedTree` wants it.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "mrpbench_mapf/bounded/corridor.hpp"
#include "mrpbench_mapf/bounded/focal_search.hpp"
#include "mrpbench_mapf/bounded/unit_conflict.hpp"

namespace mrpbench::mapf {

class UnitSpace {
 public:
  using Step = std::int32_t;
  using Conflict = UnitConflict;
  using Constraint = UnitConstraint;

  UnitSpace(const Instance& instance, const UnitRoadmap& roadmap, const BoundedOptions& options, Limits& limits,
            Statistics& statistics);

  /// A robot that cannot reach its goal, or shares its start or goal with another; or nothing.
  std::optional<int> find_hopeless();
  int robots() const { return instance_.size(); }

  void put(int robot, Steps path) { table_.add(robot, path); }
  void take(int robot) { table_.remove(robot); }

  void bind(int robot) {
    robot_ = robot;
    constraints_.reset();
  }
  void add(const UnitConstraint& constraint) {
    if (constraint.concerns(robot_)) constraint.apply(robot_, constraints_);
  }
  Tick plan(const CostBound& bound, Tick known, std::vector<Step>& path) {
    return search_.search(start(robot_), goal(robot_), distance_[robot_], constraints_, table_, bound, known, path);
  }

  void find_conflicts(int robot, Steps path, std::vector<UnitConflict>& found) const {
    mapf::find_conflicts(robot, path, table_, found);
  }
  /// `bind_to_node(robot)` must bind a robot to the constraints of the node in which the conflict is.
  template <class Bind>
  void resolve(const UnitConflict& conflict, Bind bind_to_node, std::array<std::vector<UnitConstraint>, 2>& branch) {
    std::optional<std::array<UnitConstraint, 2>> two;
    if (options_.target) two = at_target(conflict);
    if (!two && options_.corridor) two = in_corridor(conflict, bind_to_node);
    if (!two) two = split(conflict);
    branch = {std::vector{(*two)[0]}, std::vector{(*two)[1]}};
  }
  bool keeps(int robot, Steps path, const UnitConstraint& constraint) const {
    return !constraint.concerns(robot) || constraint.holds(robot, path);
  }
  Tick cost(Steps path) const { return static_cast<Tick>(path.size()) - 1; }
  Path finish(int robot, Steps path) const { return occupations(instance_, robot, path); }

 private:
  int start(int robot) const { return instance_.robots()[robot].start; }
  int goal(int robot) const { return instance_.robots()[robot].goals.front(); }
  std::optional<std::array<UnitConstraint, 2>> at_target(const UnitConflict& conflict) const;
  template <class Bind>
  std::optional<std::array<UnitConstraint, 2>> in_corridor(const UnitConflict& conflict, Bind bind_to_node) {
    const int one = conflict.one, other = conflict.other;
    auto meeting = corridors_.find(conflict, table_, {start(one), goal(one), start(other), goal(other)});
    if (!meeting) return std::nullopt;
    const auto passage = [&](int robot) {
      bind_to_node(robot);
      return corridors_.passage(meeting->chain, start(robot), constraints_);
    };
    const UnitCorridors::Passage first = passage(one);
    std::ranges::reverse(meeting->chain);
    const UnitCorridors::Passage second = passage(other);
    std::ranges::reverse(meeting->chain);
    return UnitCorridors::split(*meeting, first, second);
  }

  const Instance& instance_;
  Limits& limits_;
  const BoundedOptions& options_;
  std::vector<UnitDistance> distance_;  // by robot
  PathTable table_;
  UnitConstraints constraints_;
  FocalSearch search_;
  UnitCorridors corridors_;
  int robot_ = 0;
};

}  // namespace mrpbench::mapf
