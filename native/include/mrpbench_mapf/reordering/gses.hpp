// The order of robots that lets them arrive earliest, given where they are and how late: graph-based switchable edge
// search.
//
// Feng, Paul, Chen and Li, "A real-time rescheduling algorithm for multi-robot plan execution" (GSES), ICAPS 2024, and
// Jiang, Lin and Li, "Speedup techniques for switchable temporal plan graph optimization" (IGSES), AAAI 2025: a
// best-first search over partial orders; a node's cost is the sum of the earliest arrivals under the arcs chosen so
// far, and a node is a solution as soon as each pair of robots that is left has an arc that holds anyway.
//
// Beyond these papers, both choices of each pending decision are propagated before a node is expanded (probing). That
// finds choices that form a cycle or cost more than the best order so far, so that the other choice is forced, and
// yields the bound of `raise_bound.hpp`, which takes all robots into account that a choice delays.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/reordering/alternative_graph.hpp"

namespace mrpbench::mapf {

struct Reordering {
  /// By pair of alternative arcs: the switched arc holds. Empty if no order was found, which happens only if the
  /// planned order is a cycle.
  std::vector<char> switched;
  Cost cost = -1;                   // sum of arrivals under this order, in ticks
  Cost planned_cost = -1;           // under the planned order, -1 if it is a cycle
  Cost lower_bound = 0;             // no order reaches less; equal to `cost` if that is proved to be optimal
  Status status = Status::gave_up;  // solved = optimal; unsolvable = every order is a cycle; else the limit reached
  std::int64_t expansions = 0;
  std::int64_t probes = 0;
  std::int32_t decisions = 0;  // groups of pairs that are decided alike
};

/// The best order found within `limits` and by at most `probe_limit` probes; the planned one if none is better. The
/// number of probes, unlike the clock, ends the search at the same order on every machine (status `timeout`).
Reordering solve_gses(const AlternativeGraph& graph, Limits& limits,
                      std::int64_t work_limit = std::numeric_limits<std::int64_t>::max());

}  // namespace mrpbench::mapf
