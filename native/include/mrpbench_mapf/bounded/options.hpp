// What can be chosen in bounded-suboptimal conflict-based search, each with the paper it comes from.
#pragma once

#include <optional>

#include "mrpbench_mapf/cbs/options.hpp"

namespace mrpbench::mapf {

/// Which node to expand next: see `NodeQueue`.
enum class Selection { focal, explicit_estimation };

struct BoundedOptions {
  /// The solution costs at most this many times the lower bound; at least 1.
  double w = 1.2;
  Selection selection = Selection::explicit_estimation;
  /// Within a bound, paths that are taken over may cost more, as long as they keep to it (if moves take one tick);
  /// conflicts are rated by the cheapest paths of the robots, not the present ones; and the heuristic is asked for
  /// nodes that are to raise the lower bound (Li, Ruml and Koenig, AAAI 2021).
  CbsOptions techniques = {};
  /// The bound of one robot's path is what the other robots leave of the common bound: Chan, Li, Gange, Harabor,
  /// Stuckey and Koenig, "Flex distribution for bounded-suboptimal multi-agent path finding", AAAI 2022.
  bool flex = false;
  /// Once searches for a single robot have taken so many expansions beyond those for the first node, look for a
  /// solution by large neighbourhood search too: see `Incumbent`. Nothing: never.
  std::optional<std::int64_t> incumbent_after = 100'000;
  /// The lower level orders paths by elapsed time + `distance_weight` * distance to go + `conflict_weight` * conflicts,
  /// in ticks; without a conflict weight conflicts count more than anything else. Veerapaneni, Kusnur and Likhachev,
  /// "Effective integration of weighted cost-to-go and conflict heuristic within suboptimal CBS", AAAI 2023.
  double distance_weight = 1.2;
  double conflict_weight = 20.0;
};

}  // namespace mrpbench::mapf
