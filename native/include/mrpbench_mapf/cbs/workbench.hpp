// What all nodes of a constraint tree, and the trees for pairs of robots inside it, work with.
#pragma once

#include "mrpbench_mapf/assignment/candidates.hpp"
#include "mrpbench_mapf/cbs/mdd_cache.hpp"
#include "mrpbench_mapf/cbs/options.hpp"
#include "mrpbench_mapf/cbs/safe_intervals.hpp"
#include "mrpbench_mapf/cbs/situation.hpp"
#include "mrpbench_mapf/cbs/space_time_astar.hpp"

namespace mrpbench::mapf {

class Workbench {
 public:
  Workbench(const Instance& instance, const CbsOptions& options, Limits& limits, Statistics& statistics);

  /// The cheapest path of `robot` to `goal` under what binds it in `situation` and `more`. False if there is none.
  bool plan(const Situation& situation, int robot, int goal, std::span<const Constraint> more,
            const AvoidanceTable* others, FoundPath& path);
  /// What its cheapest path to the goal costs, whatever it costs in `situation`; kForever if it has none.
  Tick least_cost(const Situation& situation, int robot);
  /// All its cheapest paths to the goal; it must have one.
  std::shared_ptr<const Mdd> mdd(const Situation& situation, int robot);
  /// Would every one of its cheapest paths break `constraints`?
  bool costs_more(const Situation& situation, int robot, std::span<const Constraint> constraints);
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
  SpaceTimeAstar astar;
  ConstraintTable table, scratch;

 private:
  MddBuilder builder_;
  MddCache mdds_;
  std::unordered_map<Key, Tick, KeyHash> least_cost_;  // by robot and what binds it
  std::size_t counted_ = 0;
  std::unordered_map<std::int64_t, std::unique_ptr<DistanceTable>> distance_to_;  // by profile and vertex
};

/// Which robot may go where, at what cost if it is alone.
Candidates find_candidates(Workbench& bench);

/// A robot for which there is no solution at first sight, or nothing.
std::optional<int> find_hopeless(Workbench& bench);

}  // namespace mrpbench::mapf
