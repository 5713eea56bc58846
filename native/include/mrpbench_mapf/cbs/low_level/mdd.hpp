// Multi-valued decision diagrams: all cheapest paths of one robot under the constraints of a node, tick by tick.
// Sharon, Stern, Goldenberg and Felner, "The increasing cost tree search for optimal multi-agent pathfinding", AIJ
// 2013; here edges may take longer than one tick.
#pragma once

#include "mrpbench_mapf/cbs/constraints/constraint_table.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf {

class Mdd {
 public:
  struct Arc {
    std::int32_t to;    // node
    std::int32_t edge;  // -1 = waiting
  };

  int robot() const { return robot_; }
  Tick cost() const { return cost_; }
  /// Ticks of the first and last level; before and after, the robot stands or does what is committed.
  Tick first_tick() const { return first_tick_; }
  Tick last_tick() const { return first_tick_ + static_cast<Tick>(level_first_.size()) - 2; }
  /// Nodes are numbered by level, within one by vertex. Those of the level at `tick`: [begin, end).
  int level_begin(Tick tick) const { return level_first_[tick - first_tick_]; }
  int level_end(Tick tick) const { return level_first_[tick - first_tick_ + 1]; }
  int width(Tick tick) const { return level_end(tick) - level_begin(tick); }
  int node_count() const { return static_cast<int>(vertex_.size()); }
  int vertex(int node) const { return vertex_[node]; }
  Tick tick(int node) const { return tick_[node]; }
  std::span<const Arc> arcs(int node) const {
    return {arcs_.data() + arc_first_[node], arcs_.data() + arc_first_[node + 1]};
  }
  /// Node of `vertex` at `tick`, -1 = none.
  int find(int vertex, Tick tick) const;
  /// Tell whether all paths are at `vertex` at `tick` (classical instances).
  bool always_at(int vertex, Tick tick) const;
  /// Tell whether every path violates one of `constraints` (those of its robot, and `length_at_most` of others).
  bool blocked_by(std::span<const Constraint> constraints, ConstraintTable& scratch) const;
  std::size_t bytes() const;

 private:
  friend class MddBuilder;
  Mdd() = default;

  int robot_ = -1;
  Tick cost_ = 0;
  Tick first_tick_ = 0;
  bool stays_ = true;
  std::vector<std::int32_t> level_first_;
  std::vector<std::int32_t> vertex_;  // by node
  std::vector<Tick> tick_;
  std::vector<std::int32_t> arc_first_;
  std::vector<Arc> arcs_;
};

/// Builds diagrams, one after another in the same memory.
class MddBuilder {
 public:
  MddBuilder(const Space& space, Limits& limits) : space_(space), limits_(limits) {}

  /// All paths of the robot that `table` was reset for whose last move ends at tick `cost`, the least possible.
  Mdd build(const ConstraintTable& table, DistanceTable& distance, Tick cost);

 private:
  /// A move or wait to (vertex, tick), from which the goal may be out of reach.
  struct Way {
    std::int32_t vertex;
    std::int32_t edge;
    Tick tick;
  };
  void reach(const ConstraintTable& table, DistanceTable& distance, int start);
  void leave(const ConstraintTable& table, DistanceTable& distance, int vertex, Tick tick);
  void prune(const ConstraintTable& table, Tick cost);
  void number(Mdd& mdd) const;
  int find(int vertex, Tick tick) const;
  std::span<const Way> ways(int node) const {
    return {ways_.data() + way_first_[node], ways_.data() + way_first_[node + 1]};
  }

  const Space& space_;
  Limits& limits_;
  Tick first_ = 0, last_ = 0;
  std::vector<std::vector<std::int32_t>> levels_;      // vertices by tick
  std::vector<std::int32_t> level_first_, way_first_;  // nodes by tick, ways by node
  std::vector<Way> ways_;
  std::vector<std::int32_t> number_;  // by node, -1 = cannot reach the goal
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
