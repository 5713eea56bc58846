// Large neighbourhood search. A first plan by repairing one that has conflicts: Li, Chen, Harabor, Stuckey and Koenig,
// "MAPF-LNS2: Fast repairing for multi-agent path finding via large neighborhood search", AAAI 2022. Then groups of
// robots are planned anew as long as there is time: Li, Chen, Harabor, Stuckey and Koenig, "Anytime multi-agent path
// finding via large neighborhood search", IJCAI 2021.
#pragma once

#include <optional>

#include "mrpbench_mapf/limits.hpp"
#include "mrpbench_mapf/objective.hpp"

namespace mrpbench::mapf {

/// Where the first plan comes from: repairing conflicts; LaCAM, where the roadmap allows it; or LaCAM, then repairing
/// for a while, and the cheaper one.
enum class Initial { repair, lacam, either };

struct LnsOptions {
  Objective objective = Objective::flowtime;
  Initial initial = Initial::either;
  std::optional<int> neighbourhood;        // robots that are planned anew at a time; nothing: as many as bring most
  std::optional<std::int64_t> iterations;  // of repairing, and again of improving; nothing: until the clock ends it
  std::uint64_t seed = 0;
};

Result solve_lns(const Instance& instance, const LnsOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
