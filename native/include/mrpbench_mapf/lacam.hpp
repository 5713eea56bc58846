// Depth first over configurations of all robots at once, made by PIBT, with a lazily grown tree of constraints at each
// that makes the search complete: Okumura, "LaCAM: Search-based algorithm for quick multi-agent pathfinding", AAAI
// 2023. After the first plan it goes on and shortens the ways between configurations (LaCAM*): Okumura, "Improving
// LaCAM for scalable eventually optimal multi-agent pathfinding", IJCAI 2023. In turn, the plan is improved by large
// neighbourhood search, as the refiners of Okumura, "Engineering LaCAM*: Towards real-time, large-scale, and
// near-optimal multi-agent pathfinding", AAMAS 2024, do.
#pragma once

#include <optional>

#include "mrpbench_mapf/limits.hpp"
#include "mrpbench_mapf/objective.hpp"

namespace mrpbench::mapf {

struct LacamOptions {
  Objective objective = Objective::flowtime;
  bool swap = true;
  bool prioritized = true;                 // look for a second plan by planning robots in turn, nearest first
  bool guides = true;                      // else along ways that keep clear of one another; in a crowd by chance
  bool star = true;                        // go on searching configurations after the first plan
  bool neighbourhoods = true;              // replan groups of robots after the first plan
  std::optional<std::int64_t> iterations;  // of improving; nothing: until the clock ends it
  std::uint64_t seed = 0;
};

/// Needs a roadmap of unit moves, throws std::invalid_argument for any other. Complete: unsolvable if all
/// configurations were seen. The lower bound is the cost itself where all better ones were ruled out.
Result solve_lacam(const Instance& instance, const LacamOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
