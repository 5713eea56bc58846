// Conflict-based search: best first over sets of constraints, the least sum of costs first.
// Sharon, Stern, Felner and Sturtevant, "Conflict-based search for optimal multi-agent pathfinding", AIJ 2015.
#pragma once

#include "mrpbench_mapf/limits.hpp"

namespace mrpbench::mapf {

/// The solution with the least sum of arrival times among those in which every edge is crossed in its duration.
Result solve_cbs(const Instance& instance, Limits& limits);

}  // namespace mrpbench::mapf
