// The cost of the cheapest path of one robot under the constraints of a node, without the path: a search over vertices
// and the intervals in which no constraint forbids them. Their number does not depend on how long the robot waits.
// Phillips and Likhachev, "SIPP: Safe interval path planning for dynamic environments", ICRA 2011.
#pragma once

#include "mrpbench_mapf/cbs/constraints/constraint_table.hpp"
#include "mrpbench_mapf/common/lazy_rows.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf {

class SafeIntervals {
 public:
  SafeIntervals(const Space& space, Limits& limits, Statistics& statistics);

  /// The earliest end of the last move of the robot that `table` was reset for, kForever if it cannot get to a goal.
  /// `distance` leads to its goals.
  Tick least_cost(const ConstraintTable& table, DistanceTable& distance);
  /// The earliest tick at which it can be at `vertex`, to which `distance` leads; kForever if not by tick `latest`.
  Tick earliest(const ConstraintTable& table, DistanceTable& distance, int vertex, Tick latest);
  /// The earliest tick at which it can leave the elements that are `inside` (by element) for one that is not;
  /// kForever if it cannot. `distance` leads to the vertices from which such moves start.
  Tick earliest_exit(const ConstraintTable& table, DistanceTable& distance, std::span<const char> inside);

 private:
  struct State {
    Tick first, last;  // the interval
    Tick arrival;      // earliest so far
    std::int32_t vertex;
    bool closed;
  };
  struct Open {
    Tick f, h;
    std::int32_t state;  // -1 = at the end
    bool operator>(const Open& other) const { return f != other.f ? f > other.f : h > other.h; }
  };

  template <class CostAt>
  Tick run(const ConstraintTable& table, DistanceTable& distance, Tick latest, CostAt cost_at);
  void begin(const ConstraintTable& table);
  LazyRows<State>::Row states_of(int vertex);
  void push(Tick f, Tick h, int state);

  const Space& space_;
  Limits& limits_;
  Statistics& statistics_;
  // the current search
  const ConstraintTable* table_ = nullptr;
  Tick latest_ = kForever;
  LazyRows<State> states_;  // by vertex
  std::vector<Open> open_;
  std::vector<Range> blocked_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
