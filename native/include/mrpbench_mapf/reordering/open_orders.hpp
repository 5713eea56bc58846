// Which orders of two robots may stay open: whichever way all of these are decided, no robots wait in a cycle.
//
// Su, Veerapaneni and Li, "Bidirectional temporal plan graph: enabling switchable passing orders for more efficient
// multi-agent path finding plan execution", AAAI 2024. Pairs that can only be switched together, such as those along a
// corridor, form a group. A group stays open if its switched arcs close no cycle with the arcs of the plan and with the
// switched arcs of all groups that are open already. That search does not exclude cycles that use both arcs of another
// pair, which no choice of orders contains: it opens fewer groups than possible, and never one that is not safe.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_mapf/reordering/alternative_graph.hpp"

namespace mrpbench::mapf {

/// The group of each pair of alternative arcs whose order may stay open, -1 for the others.
///
/// `together` by event: the first event of a set of events that are at the same time, such as the event itself. `begin`
/// by pair: groups are tried in the order of the least value of their pairs, `limit` of them. Throws
/// std::invalid_argument if the planned order has a cycle of other events.
std::vector<std::int32_t> open_orders(const AlternativeGraph& graph, std::span<const std::int32_t> together,
                                      std::span<const std::int64_t> begin, std::int64_t limit);

}  // namespace mrpbench::mapf
