// A path for one robot that has few conflicts with the present paths of others and costs at most w times the least: the
// lower level of Barer, Sharon, Stern and Felner, "Suboptimal variants of the conflict-based search algorithm for the
// multi-agent pathfinding problem", SoCS 2014. With w = 1 it is the space-time A* of Silver, "Cooperative pathfinding",
// AIIDE 2005, with ties broken by conflicts.
#pragma once

#include <algorithm>
#include <cmath>

#include "mrpbench_mapf/cbs/constraints/avoidance_table.hpp"
#include "mrpbench_mapf/cbs/low_level/focal_queue.hpp"
#include "mrpbench_mapf/cbs/low_level/safe_intervals.hpp"
#include "mrpbench_mapf/cbs/low_level/state_table.hpp"
#include "mrpbench_mapf/cbs/options.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf {

/// At most floor(w * (least + others_least)) - others_cost, but always `least`, a lower bound on the cost of the path
/// itself. With others of zero that is w times its own bound; with what is known of all others it is what they leave.
struct CostBound {
  double w = 1.0;
  Cost others_least = 0, others_cost = 0;

  Tick operator()(Tick least) const {
    const auto total = static_cast<Cost>(std::floor(w * static_cast<double>(others_least + least)));
    return static_cast<Tick>(std::clamp<Cost>(total - others_cost, least, kForever - 1));
  }
};

class FocalSearch {
 public:
  /// After `patience` states, the cost of the cheapest path is computed first.
  FocalSearch(const Space& space, SafeIntervals& intervals, Limits& limits, Statistics& statistics,
              std::size_t patience = 1024);

  /// Writes a path of the robot that `table` was reset for, and returns a lower bound on the cost of all its paths (at
  /// least `known`, which must be one), or kForever if there is none. `distance` leads to its goals. `others` must not
  /// contain the robot itself.
  Tick search(const ConstraintTable& table, DistanceTable& distance, const AvoidanceTable& others,
              const StateOrder& order, const CostBound& bound, Tick known, FoundPath& path);

 private:
  struct Node {
    std::int32_t vertex;  // + vertex_count for the end of a path: staying there from then on
    Tick tick;
    std::int32_t parent;  // -1: none
    std::int32_t edge;    // by which it was reached, -1 = waiting
    std::int32_t conflicts;
    Tick f;
  };
  static constexpr std::int32_t kExpanded = -1;  // in `known_`

  void begin(Tick least);
  void expand(std::int32_t node);
  void reach(std::int32_t vertex, Tick tick, std::int32_t parent, std::int32_t edge, std::int32_t conflicts);
  void finish(std::int32_t node, Tick cost);
  bool push(const Node& node, Tick h);
  void trace(std::int32_t node, FoundPath& path);

  const Space& space_;
  SafeIntervals& intervals_;
  Limits& limits_;
  Statistics& statistics_;
  std::size_t patience_;
  int vertices_;
  // the current search
  const ConstraintTable* table_ = nullptr;
  DistanceTable* distance_ = nullptr;
  const AvoidanceTable* others_ = nullptr;
  StateOrder order_;
  CostBound bound_;
  Tick least_ = 0;   // no path costs less
  Tick latest_ = 0;  // no greater f matters
  std::vector<Node> nodes_;
  StateTable known_;  // the fewest conflicts with which a state was reached
  std::vector<Stop> stops_;
  FocalQueue queue_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
