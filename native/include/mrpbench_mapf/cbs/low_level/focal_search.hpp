// A path for one robot that has few conflicts with the present paths of others and costs at most w times the least: the
// lower level of Barer, Sharon, Stern and Felner, "Suboptimal variants of the conflict-based search algorithm for the
// multi-agent pathfinding problem", SoCS 2014.
#pragma once

#include <algorithm>
#include <cmath>

#include "mrpbench_mapf/cbs/bounded_options.hpp"
#include "mrpbench_mapf/cbs/constraints/avoidance_table.hpp"
#include "mrpbench_mapf/cbs/low_level/focal_queue.hpp"
#include "mrpbench_mapf/cbs/low_level/safe_intervals.hpp"
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
  /// After `patience` states, what the cheapest path costs is found out first.
  FocalSearch(const Space& space, SafeIntervals& intervals, const BoundedOptions& options, Limits& limits,
              Statistics& statistics, std::size_t patience = 1024);

  /// Writes a path of the robot that `table` was reset for, and returns a lower bound on the cost of all its paths (at
  /// least `known`, which must be one), or kForever if there is none. `distance` leads to its goals. `others` must not
  /// contain the robot itself.
  Tick search(const ConstraintTable& table, DistanceTable& distance, const AvoidanceTable& others,
              const CostBound& bound, Tick known, FoundPath& path);

 private:
  struct Node {
    std::int32_t vertex;  // + vertex_count for the end of a path: staying there from then on
    Tick tick;
    std::int32_t parent;  // -1: none
    std::int32_t edge;    // by which it was reached, -1 = waiting
    std::int32_t conflicts;
    bool closed;
  };
  std::int32_t& slot(std::int32_t vertex, Tick tick);
  void grow();
  void reach(std::int32_t vertex, Tick tick, std::int32_t parent, std::int32_t edge, std::int32_t conflicts);
  void finish(std::int32_t node, Tick cost);
  void relax(const Node& node, Tick f, Tick h);
  void expand(std::int32_t node);
  void begin(Tick least, const CostBound& bound);
  void trace(std::int32_t node, FoundPath& path);
  int column(Tick f, Tick h, std::int32_t conflicts) const;

  const Space& space_;
  SafeIntervals& intervals_;
  const BoundedOptions& options_;
  Limits& limits_;
  Statistics& statistics_;
  std::size_t patience_;
  int vertices_;
  // the current search
  const ConstraintTable* table_ = nullptr;
  DistanceTable* distance_ = nullptr;
  const AvoidanceTable* others_ = nullptr;
  Tick least_ = 0;  // no path costs less
  std::vector<Node> nodes_;
  std::vector<std::int32_t> known_;  // by hash of vertex and tick: node + 1, 0 = none
  std::vector<Stop> stops_;
  FocalQueue queue_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
