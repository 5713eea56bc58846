// Moves that a robot may leave out of a plan, because it comes back to where it was.
#pragma once

#include "mrpbench_mapf/model/relations.hpp"
#include "mrpbench_mapf/model/result.hpp"

namespace mrpbench::mapf {

/// Let each robot stay at a vertex to which it returns within the horizon, if nobody needs that vertex in between. So
/// one that steps forward, and back when another one comes, waits for that one instead.
///
/// In `paths` without conflicts, in place; they end where they did, and not later.
void leave_out_returns(const Instance& instance, const Relations& relations, std::vector<Path>& paths, Limits& limits);

}  // namespace mrpbench::mapf
