// What can be chosen in bounded-suboptimal conflict-based search, each with the paper it comes from.
#pragma once

namespace mrpbench::mapf {

/// Which node to expand next: see `NodeQueue`.
enum class Selection { focal, explicit_estimation };

struct BoundedOptions {
  /// The solution costs at most this many times the lower bound; at least 1.
  double w = 1.2;
  Selection selection = Selection::explicit_estimation;
  /// Take over paths within the bound that have fewer conflicts instead of branching: Boyarski et al., "Don't split,
  /// try to work it out: bypassing conflicts in multi-agent pathfinding", ICAPS 2015; within a bound Li, Ruml and
  /// Koenig, AAAI 2021.
  bool bypass = true;
  /// Resolve conflicts with robots at their goals by their time of arrival: Li, Harabor, Stuckey, Ma, Gange and Koenig,
  /// "Pairwise symmetry reasoning for multi-agent path finding search", AIJ 2021.
  bool target = true;
  /// Resolve head-on conflicts in corridors by the time of leaving the corridor (same paper).
  bool corridor = true;
  /// The bound of one robot's path is what the other robots leave of the common bound: Chan, Li, Gange, Harabor,
  /// Stuckey and Koenig, "Flex distribution for bounded-suboptimal multi-agent path finding", AAAI 2022.
  bool flex = false;
  /// The lower level orders paths by elapsed time + `distance_weight` * distance to go + `conflict_weight` * conflicts,
  /// in ticks; without a conflict weight conflicts count more than anything else. Veerapaneni, Kusnur and Likhachev,
  /// "Effective integration of weighted cost-to-go and conflict heuristic within suboptimal CBS", AAAI 2023.
  double distance_weight = 1.2;
  double conflict_weight = 20.0;
};

}  // namespace mrpbench::mapf
