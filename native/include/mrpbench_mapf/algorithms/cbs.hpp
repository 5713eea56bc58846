// Conflict-based search: plans with the least sum of arrival times. See `cbs/` for its parts.
#pragma once

#include "mrpbench_mapf/cbs/options.hpp"
#include "mrpbench_mapf/model/result.hpp"

namespace mrpbench::mapf {

/// The solution with the least sum of arrival times among those in which every edge is crossed in its duration; over
/// all assignments of robots to different goals if `options.goals` says so.
Result solve_cbs(const Instance& instance, const CbsOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
