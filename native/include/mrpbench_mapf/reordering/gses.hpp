// The order of robots that lets them arrive earliest, given where they are and how late: graph-based switchable edge
// search.
//
// Feng, Paul, Chen and Li, "A real-time rescheduling algorithm for multi-robot plan execution" (GSES), ICAPS 2024, and
// Jiang, Lin and Li, "Speedup techniques for switchable temporal plan graph optimization" (IGSES), AAAI 2025: a
// best-first search over partial orders; a node's cost is the sum of the earliest arrivals under the arcs chosen so
// far, and a node is a solution as soon as each pair of robots that is left has an arc that holds anyway.
//
// Beyond these papers, local search improves the planned order first (`local_search.hpp`): the best-first search then
// only has to look for better orders, and with many robots, for which it does not come to an end, there is a good one.
// And both choices of each pending decision are propagated before a node is expanded (probing). That finds choices that
// form a cycle or cost more than the best order so far, so that the other choice is forced, and yields the bound of
// `raise_bound.hpp`, which takes all robots into account that a choice delays.
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
  std::int64_t work = 0;       // times of events computed
  std::int32_t decisions = 0;  // groups of pairs that are decided alike
};

/// The best order found within `limits` and until `work_limit` times of events have been computed; the planned one if
/// none is better. That number, unlike the clock, ends the search at the same order on every machine (status
/// `timeout`). The search looks at it before it computes the consequences of a choice, all of which count.
Reordering solve_gses(const AlternativeGraph& graph, Limits& limits,
                      std::int64_t work_limit = std::numeric_limits<std::int64_t>::max());

}  // namespace mrpbench::mapf
