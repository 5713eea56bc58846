// What can be switched off in conflict-based search, each with the paper it comes from.
#pragma once

#include <cstdint>

#include "mrpbench_mapf/common/options.hpp"

namespace mrpbench::mapf {

/// Where robots are sent.
enum class GoalChoice {
  /// To any of their goals, each on its own.
  own,
  /// To different goals, all at once, the cheapest assignment first: Hoenig et al., AAMAS 2018 (CBS-TA).
  ranked,
  /// To different goals by the constraints of each node: Tang et al., MRS 2023 (ITA-CBS). Then `heuristic` does not
  /// count, since what pairs cost together may be avoided by other goals.
  by_node,
};

struct CbsOptions {
  GoalChoice goals = GoalChoice::own;
  /// Cardinal conflicts first: Boyarski et al., "ICBS: Improved conflict-based search algorithm for multi-agent
  /// pathfinding", IJCAI 2015.
  bool prioritize = true;
  /// Take over paths as cheap with fewer conflicts instead of branching: Boyarski et al., "Don't split, try to work it
  /// out: bypassing conflicts in multi-agent pathfinding", ICAPS 2015.
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
  /// Expansions after which the search for a pair of robots in `heuristic` ends with the bound it has.
  std::int64_t pair_expansions = 64;

  static Description<CbsOptions> description() {
    Description<CbsOptions> rows{goal_choice()};
    for (const auto& row : techniques()) rows.push_back(row);
    rows.push_back(heuristic_choice());
    return rows;
  }
  static Option<CbsOptions> goal_choice() {
    return {
        "goal_choice", &CbsOptions::goals,
        Choices<GoalChoice>{{"own", GoalChoice::own}, {"ranked", GoalChoice::ranked}, {"by_node", GoalChoice::by_node}},
        "Where robots go: own (each robot to any of its goals), ranked or by_node (all robots to different goals, by "
        "a tree for each of the cheapest assignments, or by an assignment in each node)"};
  }
  static Description<CbsOptions> techniques() {
    return {
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
         "disjunctive arcs; Carlier and Pinson, Management Science 1989"}};
  }
  static Option<CbsOptions> heuristic_choice() {
    return {"heuristic", &CbsOptions::heuristic,
            "Raises the lower bound of nodes by the cost that pairs of robots still have to pay",
            "WDG; Li, Felner et al., IJCAI 2019"};
  }
};

}  // namespace mrpbench::mapf
