// Depth first over configurations of all robots at once, made by PIBT, with a lazily grown tree of constraints at each
// that makes the search complete: Okumura, "LaCAM: Search-based algorithm for quick multi-agent pathfinding", AAAI
// 2023. After the first plan it goes on and shortens the ways between configurations (LaCAM*): Okumura, "Improving
// LaCAM for scalable eventually optimal multi-agent pathfinding", IJCAI 2023. In turn, the plan is improved by large
// neighbourhood search, as the refiners of Okumura, "Engineering LaCAM*: Towards real-time, large-scale, and
// near-optimal multi-agent pathfinding", AAMAS 2024, do.
#pragma once

#include "mrpbench_mapf/lacam/options.hpp"
#include "mrpbench_mapf/model/result.hpp"

namespace mrpbench::mapf {

/// Needs robots with one goal each, where they stay; throws std::invalid_argument for others. Where every move takes a
/// tick and robots exclude one another only at one vertex, it is complete (unsolvable if all configurations were seen),
/// and the lower bound is the cost itself where all better ones were ruled out. Elsewhere a configuration says where
/// robots stand between their moves, whose order is planned (`lacam/joint_moves.hpp`); the search is complete if a
/// robot on an edge excludes all that it excludes at its end, and otherwise gives up when it has seen all.
Result solve_lacam(const Instance& instance, const LacamOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
