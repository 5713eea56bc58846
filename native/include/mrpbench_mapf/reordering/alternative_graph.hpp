// What may still be decided about the order of robots while a plan is executed, as an alternative graph.
//
// Mascis and Pacciarelli, "Job-shop scheduling with blocking and no-wait constraints", EJOR 2002. The switchable edges
// of Feng, Paul, Chen and Li, "A real-time rescheduling algorithm for multi-robot plan execution" (GSES), ICAPS 2024,
// are its pairs of alternative arcs.
//
// Every robot has events in a fixed order, such as its arrivals at the vertices of its path. The first event of each
// robot is at time 0, the last one is its arrival at its goal. Times are in ticks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

/// Event `after` is at least `lag` ticks later than event `before` of another robot; lag >= 1.
struct Arc {
  std::int32_t before;
  std::int32_t after;
  Tick lag;
};

/// Two robots that need the same place: exactly one of the arcs holds. In `planned` the robot that the plan lets pass
/// first passes first, in `switched` the other one. Between them, they connect the same two robots in both directions.
struct Alternatives {
  Arc planned;
  Arc switched;
};

struct AlternativeGraph {
  std::vector<std::int32_t> first;  // the events of robot r are [first[r], first[r + 1])
  std::vector<Tick> duration;       // least time from an event to the next one of its robot, >= 1
  std::vector<Arc> fixed;
  std::vector<Alternatives> alternatives;

  int robots() const { return static_cast<int>(first.size()) - 1; }
  int events() const { return first.back(); }
  /// Throws std::invalid_argument, in one line, for indices out of range, arcs within one robot, and times below 1.
  void check() const;
};

/// The same graph without events that no arc touches and that are neither the first nor the last of a robot.
AlternativeGraph reduced(const AlternativeGraph& graph);

/// The earliest time of each event, given arcs that hold; nothing if they form a cycle.
std::vector<Tick> earliest_times(std::span<const std::int32_t> first, std::span<const Tick> duration,
                                 std::span<const Arc> arcs);

/// Sum over the robots of the earliest time of their last event, given one arc of each pair: `switched[k]` tells which
/// one of the k-th. -1 where the arcs form a cycle: some robots would wait for one another for ever.
Cost cost_of_order(const AlternativeGraph& graph, std::span<const char> switched);

}  // namespace mrpbench::mapf
