// Planning for single robots on any roadmap, with everything that instances may contain, as `BoundedTree` wants it: by
// safe intervals. A robot takes its earliest path, or one around all the others if that is within the bound.
#pragma once

#include <array>
#include <optional>

#include "mrpbench_mapf/bounded/cost_bound.hpp"
#include "mrpbench_mapf/bounded/options.hpp"
#include "mrpbench_mapf/cbs/constraint.hpp"
#include "mrpbench_mapf/sipp.hpp"

namespace mrpbench::mapf {

/// A conflict of two paths, with the constraints that resolve it.
struct IntervalConflict {
  std::int32_t one, other;
  Half time;
  std::array<Constraint, 2> branch;
};

/// The constraints of one robot, listed by element, what the others do for certain, and what they do at present if that
/// is to be avoided too.
class IntervalConstraints final : public Obstacles {
 public:
  IntervalConstraints(const Roadmap& roadmap, const Reservations& certain, Limits& limits);

  void reset(int robot);
  void add(const Constraint& constraint);
  void avoid(const Reservations* present) { present_ = present; }
  void at_vertex(int vertex, std::vector<Range>& halves) const override;
  void on_edge(int edge, Tick duration, std::vector<Range>& departures) const override;

 private:
  struct Entry {
    Range range;
    std::int32_t next;
  };
  void list(int element, std::vector<Range>& ranges) const;

  const Reservations& certain_;
  const Reservations* present_ = nullptr;
  int vertex_count_;
  int robot_ = -1;
  std::vector<std::int32_t> head_;  // by element, -1 = none
  std::vector<std::int32_t> touched_;
  std::vector<Entry> entries_;
};

class IntervalSpace {
 public:
  using Step = Occupation;
  using Conflict = IntervalConflict;
  using Constraint = mapf::Constraint;

  IntervalSpace(const Instance& instance, const BoundedOptions& options, Limits& limits, Statistics& statistics);

  /// A robot for which there is no solution at first sight, or nothing.
  std::optional<int> find_hopeless();
  int robots() const { return instance_.size(); }

  void put(int robot, std::span<const Occupation> path);
  void take(int robot) { put(robot, {}); }

  void bind(int robot);
  void add(const Constraint& constraint) {
    if (constraint.robot == robot_) constraints_.add(constraint);
  }
  Tick plan(const CostBound& bound, Tick known, Path& path);

  void find_conflicts(int robot, std::span<const Occupation> path, std::vector<IntervalConflict>& found);
  template <class Bind>
  void resolve(const IntervalConflict& conflict, Bind, std::array<std::vector<Constraint>, 2>& branch) const {
    branch = {std::vector{conflict.branch[0]}, std::vector{conflict.branch[1]}};
  }
  /// A constraint is made to forbid what its robot does.
  bool keeps(int robot, std::span<const Occupation>, const Constraint& constraint) const {
    return constraint.robot != robot;
  }
  Tick cost(std::span<const Occupation> path) const { return arrival(path); }
  Path finish(int, std::span<const Occupation> path) const { return {path.begin(), path.end()}; }

 private:
  const Reservations& present();
  bool meets_others(std::span<const Occupation> path);

  const Instance& instance_;
  Limits& limits_;
  DistanceTables tables_;
  Relations relations_;
  Reservations certain_;  // what the robots do in any case
  Reservations present_;  // what they do in the node at hand
  bool stale_ = false;    // `present_` differs from `paths_`
  std::vector<std::span<const Occupation>> paths_;
  IntervalConstraints constraints_;
  Sipp sipp_;
  int robot_ = -1;
  Path around_;
};

}  // namespace mrpbench::mapf
