// The options of conflict-based search, each with the paper that it comes from.
#pragma once

#include <cstdint>
#include <optional>

#include "mrpbench_options/options.hpp"

namespace mrpbench::mapf {

/// Where robots go.
enum class GoalChoice {
  /// Each robot to any of its goals.
  own,
  /// All robots to different goals, the cheapest assignment first: Hoenig et al., AAMAS 2018 (CBS-TA).
  ranked,
  /// All robots to different goals, by the constraints of each node: Tang et al., MRS 2023 (ITA-CBS). Then `heuristic`
  /// has no effect, since what pairs cost together may be avoided by other goals.
  by_node,
};

/// Which node is expanded next: see `OpenList`.
enum class Selection { best_first, focal, explicit_estimation };

/// The search for one robot orders states by elapsed time + `distance_weight` * distance to go + `conflict_weight` *
/// conflicts, in ticks; without a conflict weight conflicts count more than anything else. Veerapaneni, Kusnur and
/// Likhachev, "Effective integration of weighted cost-to-go and conflict heuristic within suboptimal CBS", AAAI 2023.
struct StateOrder {
  double distance_weight = 1.0;
  double conflict_weight = 0.0;
};

/// The defaults are those of CBS with all techniques.
struct CbsOptions {
  GoalChoice goals = GoalChoice::own;
  Selection selection = Selection::best_first;
  /// The solution costs at most this many times the lower bound; at least 1.
  double w = 1.0;
  /// Cardinal conflicts first: Boyarski et al., "ICBS: Improved conflict-based search algorithm for multi-agent
  /// pathfinding", IJCAI 2015. Cardinality refers to the cheapest paths of the robots, not to the present ones.
  bool prioritize = true;
  /// Take over paths with fewer conflicts instead of branching: Boyarski et al., "Don't split, try to work it out:
  /// bypassing conflicts in multi-agent pathfinding", ICAPS 2015. The paths may cost more within the bound if moves
  /// take one tick: Li, Ruml and Koenig, AAAI 2021.
  bool bypass = true;
  /// A lower bound on the cost to go from the dependencies of pairs: Li et al., "Improved heuristics for multi-agent
  /// path finding with conflict-based search", IJCAI 2019 (WDG).
  bool heuristic = true;
  /// Target, corridor and generalised rectangle reasoning: Li et al., "Pairwise symmetry reasoning for multi-agent path
  /// finding search", AIJ 2021.
  bool target = true;
  bool corridor = true;
  bool rectangle = true;
  /// Which robot uses a resource first: Carlier and Pinson, "An algorithm for solving the job-shop problem", Management
  /// Science 1989.
  bool precedence = true;
  /// The bound of one robot's path is what the other robots leave of the common bound: Chan, Li, Gange, Harabor,
  /// Stuckey and Koenig, "Flex distribution for bounded-suboptimal multi-agent path finding", AAAI 2022.
  bool flex = false;
  /// Low-level expansions beyond those for the first node after which large neighbourhood search also looks for a
  /// solution: see `AnytimeFallback`. Nothing: never.
  std::optional<std::int64_t> incumbent_after = std::nullopt;
  StateOrder order = {};
  /// Expansions after which the search for a pair of robots in `heuristic` ends with the bound it has.
  std::int64_t pair_expansions = 64;

  static Description<CbsOptions> description() {
    return {
        {"goal_choice", &CbsOptions::goals,
         Choices<GoalChoice>{
             {"own", GoalChoice::own}, {"ranked", GoalChoice::ranked}, {"by_node", GoalChoice::by_node}},
         "Where robots go: own (each robot to any of its goals), ranked or by_node (all robots to different goals, by "
         "a tree for each of the cheapest assignments, or by an assignment in each node)"},
        {"prioritize", &CbsOptions::prioritize, "Resolves first the conflicts that raise the lower bound either way",
         "Boyarski et al., IJCAI 2015"},
        {"bypass", &CbsOptions::bypass,
         "Adopts paths with fewer conflicts, where the bound allows it, instead of branching",
         "Boyarski et al., ICAPS 2015"},
        {"target", &CbsOptions::target, "Resolves conflicts with robots at their goals by the times of arrival",
         "Li et al., AIJ 2021"},
        {"corridor", &CbsOptions::corridor,
         "Delays one of two robots that meet in a corridor by the length of the corridor", "Li et al., AIJ 2021"},
        {"rectangle", &CbsOptions::rectangle,
         "Delays one of two robots that cross the same region until the other has left it; needs unit durations and "
         "no footprints",
         "generalised rectangles; Li et al., AIJ 2021"},
        {"precedence", &CbsOptions::precedence,
         "Delays one of two robots that use a door, lift or mutex until the other could have left it",
         "disjunctive arcs; Carlier and Pinson, Management Science 1989"},
        {"selection", &CbsOptions::selection,
         Choices<Selection>{{"best_first", Selection::best_first},
                            {"focal", Selection::focal},
                            {"explicit_estimation", Selection::explicit_estimation}},
         "Which node is expanded next: best_first (CBS), focal (ECBS) or explicit_estimation (EECBS)"},
        {"w", &CbsOptions::w, within(1.0, 1e9), "The plan costs at most this many times the lower bound"},
        {"heuristic", &CbsOptions::heuristic,
         "Raises the lower bound of nodes by the cost that pairs of robots still have to pay",
         "WDG; Li, Felner et al., IJCAI 2019"},
        {"flex", &CbsOptions::flex, "Lets the path of a robot use what the other robots leave of the common bound",
         "Chan et al., AAAI 2022"},
        {"incumbent_after", &CbsOptions::incumbent_after, at_least(0),
         "Low-level expansions after which large neighbourhood search also looks for a plan within the bound; "
         "none = the plan always comes from the constraint tree, as in the original"},
        {{"distance_weight", &StateOrder::distance_weight, within(1.0, 1e3),
          "The search for one robot orders states by elapsed time + this many times the distance to go + "
          "`conflict_weight` ticks per conflict",
          "Veerapaneni, Kusnur and Likhachev, AAAI 2023"},
         &CbsOptions::order},
        {{"conflict_weight", &StateOrder::conflict_weight, within(0.0, 1e6),
          "See `distance_weight`; 0 = conflicts count before everything else, as in the original"},
         &CbsOptions::order}};
  }
};

}  // namespace mrpbench::mapf
