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
  bool prioritized = true;
  bool guides = true;
  bool star = true;
  bool neighbourhoods = true;
  std::optional<std::int64_t> iterations;
  std::uint64_t seed = 0;

  static Description<LacamOptions> description() {
    return {
        objective_option<LacamOptions>(),
        {"swap", &LacamOptions::swap,
         "Lets robots change places in narrow passages; without it the first plan may take long"},
        {"prioritized", &LacamOptions::prioritized,
         "After the first plan, looks for a cheaper one by planning robots in turn, nearest first"},
        {"guides", &LacamOptions::guides,
         "If that fails, looks for a cheaper plan along guide paths that avoid each other; in a crowd, where there are "
         "none, draws further first plans at random",
         "Okumura, AAMAS 2024"},
        {"star", &LacamOptions::star, "After the first plan, continues the search over configurations",
         "Okumura, IJCAI 2023"},
        {"neighbourhoods", &LacamOptions::neighbourhoods,
         "After the first plan, improves it by large neighbourhood search"},
        {"iterations", &LacamOptions::iterations, at_least(0), "Steps of improvement; none = until time is over"},
        {"seed", &LacamOptions::seed, "Seed of all random choices"}};
  }
};

/// Needs a roadmap of unit moves, throws std::invalid_argument for any other. Complete: unsolvable if all
/// configurations were seen. The lower bound is the cost itself where all better ones were ruled out.
Result solve_lacam(const Instance& instance, const LacamOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
