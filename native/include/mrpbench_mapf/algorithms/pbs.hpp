// Priority-based search: depth first over partial orders of robots, each of which plans around those before it.
// Ma, Harabor, Stuckey, Li and Koenig, "Searching with consistent prioritization for multi-agent path finding",
// AAAI 2019.
#pragma once

#include "mrpbench_mapf/model/result.hpp"
#include "mrpbench_options/options.hpp"

namespace mrpbench::mapf {

struct PbsOptions {
  static Description<PbsOptions> description() { return {}; }
};

/// Gives up if no partial order leads to a plan, which proves nothing.
Result solve_pbs(const Instance& instance, const PbsOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
