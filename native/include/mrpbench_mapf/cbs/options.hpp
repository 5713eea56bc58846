// What can be switched off in conflict-based search, each with the paper it comes from.
#pragma once

#include <cstdint>

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
  /// Expansions after which the search for a pair of robots in `heuristic` ends with the bound it has.
  std::int64_t pair_expansions = 64;
};

}  // namespace mrpbench::mapf
