// Conflict-based search whose solutions cost at most w times the least.
//   ECBS: Barer, Sharon, Stern and Felner, "Suboptimal variants of the conflict-based search algorithm for the
//     multi-agent pathfinding problem", SoCS 2014.
//   EECBS: Li, Ruml and Koenig, "EECBS: a bounded-suboptimal search for multi-agent path finding", AAAI 2021.
#pragma once

#include "mrpbench_mapf/cbs/bounded_options.hpp"
#include "mrpbench_mapf/model/result.hpp"

namespace mrpbench::mapf {

/// A solution whose sum of arrival times is at most `options.w` times the lower bound of the result.
Result solve_bounded(const Instance& instance, const BoundedOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
