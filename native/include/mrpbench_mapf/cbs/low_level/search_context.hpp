// What all nodes of a constraint tree, and the trees for pairs of robots, share.
#pragma once

#include "mrpbench_mapf/assignment/candidates.hpp"
#include "mrpbench_mapf/cbs/constraints/node_state.hpp"
#include "mrpbench_mapf/cbs/low_level/focal_search.hpp"
#include "mrpbench_mapf/cbs/low_level/mdd_cache.hpp"
#include "mrpbench_mapf/cbs/low_level/soft_intervals.hpp"
#include "mrpbench_mapf/cbs/options.hpp"

namespace mrpbench::mapf {

class SearchContext {
 public:
  SearchContext(const Instance& instance, const CbsOptions& options, Limits& limits, Statistics& statistics);

  /// Cost of the cheapest path of `robot` to its goal under its constraints in `state`; kForever if it has none.
  Tick least_cost(const NodeState& state, int robot);
  /// All its cheapest paths to the goal, of which there must be one.
  std::shared_ptr<const Mdd> mdd(const NodeState& state, int robot);
  /// Tell whether each of its cheapest paths violates `constraints`.
  bool costs_more(const NodeState& state, int robot, std::span<const Constraint> constraints);
  /// Distances to one vertex with the motion profile of `robot`.
  DistanceTable& distance_to(int robot, int vertex);
  /// The same to `goal`, or to the nearest of its goals if that is `TimedPath::kAnyGoal`.
  DistanceTable& distance_to_goal(int robot, int goal);

  const CbsOptions options;
  Limits& limits;
  Statistics& statistics;
  const Space space;
  DistanceTables distances;
  SafeIntervals intervals;
  FocalSearch search;
  /// Only if there are resources, for which robots wait long: then instead of searches tick by tick.
  std::optional<SoftIntervals> soft_intervals;
  ConstraintTable table, scratch;

 private:
  MddBuilder builder_;
  MddCache mdds_;
  std::unordered_map<Key, Tick, KeyHash> least_cost_;  // by robot and what binds it
  std::size_t counted_ = 0;
  std::unordered_map<std::int64_t, std::unique_ptr<DistanceTable>> distance_to_;  // by profile and vertex
};

/// The goals that each robot may take, and the cost of each if the robot is alone.
Candidates find_candidates(SearchContext& context);

/// A robot because of which quick checks prove that there is no solution; nothing if they prove nothing.
std::optional<int> prove_infeasible(SearchContext& context);

}  // namespace mrpbench::mapf
