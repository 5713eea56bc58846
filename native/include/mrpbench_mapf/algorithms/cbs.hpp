// Conflict-based search and its bounded-suboptimal variants; see `cbs/` for their parts.
//   CBS: Sharon, Stern, Felner and Sturtevant, "Conflict-based search for optimal multi-agent pathfinding", AIJ 2015.
//   ECBS: Barer, Sharon, Stern and Felner, "Suboptimal variants of the conflict-based search algorithm for the
//     multi-agent pathfinding problem", SoCS 2014.
//   EECBS: Li, Ruml and Koenig, "EECBS: a bounded-suboptimal search for multi-agent path finding", AAAI 2021.
#pragma once

#include "mrpbench_mapf/cbs/options.hpp"
#include "mrpbench_mapf/model/result.hpp"

namespace mrpbench::mapf {

/// A solution whose sum of arrival times is at most `options.w` times the lower bound of the result, among those in
/// which every edge is crossed in its duration; over all assignments of robots to different goals if `options.goals`
/// says so.
Result solve_cbs(const Instance& instance, const CbsOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
