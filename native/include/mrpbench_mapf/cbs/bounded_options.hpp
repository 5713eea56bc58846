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

  static Description<BoundedOptions> description() {
    Description<BoundedOptions> rows;
    append(rows, {CbsOptions::goal_choice()}, &BoundedOptions::techniques);
    append(rows, CbsOptions::techniques(), &BoundedOptions::techniques);
    rows.push_back(
        {"selection", &BoundedOptions::selection,
         Choices<Selection>{{"focal", Selection::focal}, {"explicit_estimation", Selection::explicit_estimation}},
         "Which node is expanded next: focal (ECBS) or explicit_estimation (EECBS)"});
    rows.push_back(
        {"w", &BoundedOptions::w, within(1.0, 1e9), "The plan costs at most this many times the lower bound"});
    append(rows, {CbsOptions::heuristic_choice()}, &BoundedOptions::techniques);
    rows.push_back({"flex", &BoundedOptions::flex,
                    "Lets the path of a robot use what the other robots leave of the common bound",
                    "Chan et al., AAAI 2022"});
    rows.push_back(
        {"incumbent_after", &BoundedOptions::incumbent_after, at_least(0),
         "Low-level expansions after which large neighbourhood search also looks for a plan within the bound; "
         "none = the plan always comes from the constraint tree, as in the original"});
    rows.push_back({"distance_weight", &BoundedOptions::distance_weight, within(1.0, 1e3),
                    "The search for one robot orders states by elapsed time + this many times the distance to go + "
                    "`conflict_weight` ticks per conflict",
                    "Veerapaneni, Kusnur and Likhachev, AAAI 2023"});
    rows.push_back({"conflict_weight", &BoundedOptions::conflict_weight, within(0.0, 1e6),
                    "See `distance_weight`; 0 = conflicts count before everything else, as in the original"});
    return rows;
  }
};

}  // namespace mrpbench::mapf
