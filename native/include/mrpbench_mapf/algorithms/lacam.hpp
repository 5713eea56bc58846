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

/// Needs a roadmap of unit moves, throws std::invalid_argument for any other. Complete: unsolvable if all
/// configurations were seen. The lower bound is the cost itself where all better ones were ruled out.
Result solve_lacam(const Instance& instance, const LacamOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
