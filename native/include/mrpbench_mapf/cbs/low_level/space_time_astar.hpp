// The cheapest path of one robot under the constraints of a node: A* over vertices and ticks with true distances as
// heuristic (Silver, "Cooperative Pathfinding", AIIDE 2005), ties broken by conflicts with the other robots.
#pragma once

#include <limits>

#include "mrpbench_mapf/cbs/constraints/avoidance_table.hpp"
#include "mrpbench_mapf/cbs/low_level/bucket_queue.hpp"
#include "mrpbench_mapf/cbs/low_level/safe_intervals.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf {

class SpaceTimeAstar {
 public:
  /// After `patience` nodes, what the path costs is found out first.
  SpaceTimeAstar(const Space& space, SafeIntervals& intervals, Limits& limits, Statistics& statistics,
                 std::size_t patience = 1024);

  /// The path with the earliest last move of the robot that `table` was reset for, which stays at a goal for good
  /// (unless robots disappear there). `distance` leads to its goals. Among equally early paths one with the fewest
  /// conflicts with `others`. False if there is none.
  bool search(const ConstraintTable& table, DistanceTable& distance, const AvoidanceTable* others, FoundPath& path);

 private:
  struct Node {
    std::int32_t vertex;
    Tick tick;
    std::int32_t parent;  // index of a node, -1 = none
    std::int32_t edge;    // by which it was reached, -1 = waiting
    std::int32_t conflicts;
  };
  /// What is known of a vertex at a tick, or (tick -1) of a vertex once nothing changes any more.
  struct Seen {
    std::uint32_t epoch;
    std::int32_t vertex;
    Tick tick;
    std::int32_t conflicts;  // least so far, -1 = expanded
  };
  static constexpr std::int32_t kUnknown = 1 << 30;
  static constexpr std::size_t kSmallSeen = 1 << 12;
  static constexpr std::size_t kWholeSearch = std::numeric_limits<std::size_t>::max();

  bool begin(const ConstraintTable& table, DistanceTable& distance, const AvoidanceTable* others, Tick least,
             Tick latest);
  /// Expand best first until `is_final(node)`; the index of that node, -1 = none.
  static constexpr int kNone = -1, kLong = -2;
  int run(std::size_t most_nodes);
  bool is_final(const Node& node);
  void expand(int index);
  void push(int vertex, Tick tick, int parent, int edge, int conflicts, Tick h);
  Seen& seen(int vertex, Tick tick);
  void forget_seen(std::size_t size);
  void grow_seen();
  void trace(int index, FoundPath& path);

  const Space& space_;
  SafeIntervals& intervals_;
  const Roadmap& roadmap_;
  Limits& limits_;
  Statistics& statistics_;
  std::size_t patience_;
  // the current search
  const ConstraintTable* table_ = nullptr;
  DistanceTable* distance_ = nullptr;
  const AvoidanceTable* others_ = nullptr;
  Tick least_ = 0, latest_ = 0;
  Tick merged_from_ = 0;  // from then on all ticks of a vertex are one state
  std::vector<Node> nodes_;
  std::vector<Stop> stops_;  // of the path that was found
  BucketQueue<std::int32_t> open_;
  /// Open addressing in the first `seen_mask_` + 1 slots, few at first so that they stay in the cache; valid entries
  /// have the present epoch.
  std::vector<Seen> seen_;
  std::size_t seen_mask_ = 0;
  std::uint32_t epoch_ = 0;
  std::size_t seen_count_ = 0;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
