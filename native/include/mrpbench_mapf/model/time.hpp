// Integer time. A robot stands at vertices during closed intervals and is on edges during open ones, so one tick has
// two parts: the half-tick 2t is the instant of tick t, the half-tick 2t+1 the open interval (t, t+1). In half-ticks
// every occupation is a closed interval of integers, and two of them overlap exactly when the intervals meet.
#pragma once

#include <algorithm>
#include <cstdint>

namespace mrpbench::mapf {

using Tick = std::int32_t;
using Half = std::int32_t;
using Cost = std::int64_t;

inline constexpr Tick kForever = (1 << 30) - 1;
inline constexpr Half kForeverHalf = 2 * kForever;
// Greatest values that instances may contain, so that sums of them stay below kForever.
inline constexpr Tick kLongestEdge = 1 << 20;
inline constexpr Tick kLatestTime = 1 << 28;

/// A closed interval of integers (ticks or half-ticks, as the user says).
struct Range {
  std::int32_t first;
  std::int32_t last;

  bool operator==(const Range&) const = default;
};

/// A robot on one element of the roadmap: vertex v is element v, edge e is element vertex_count + e.
/// At a vertex from tick a to b: [2a, 2b]; on an edge from a to b: [2a+1, 2b-1].
struct Occupation {
  std::int32_t element;
  Half begin;
  Half end;

  bool operator==(const Occupation&) const = default;
};

inline Occupation at_vertex(int vertex, Tick arrive, Tick depart) {
  return {vertex, 2 * arrive, 2 * depart};
}
inline Occupation on_edge(int element, Tick enter, Tick leave) {
  return {element, 2 * enter + 1, 2 * leave - 1};
}

/// The half-ticks during which another robot must not be there, when each of both may be up to `k` ticks late: before
/// the occupation, because the other one may leave late, and after it, because this one may.
inline Range widened(Half begin, Half end, Tick k) {
  return {std::max(begin - 2 * k, 0), end > kForeverHalf - 2 * k ? kForeverHalf : end + 2 * k};
}

/// The departures d at which a robot would be on an edge, [2d + 1, 2(d + duration) - 1], during `halves`; perhaps none.
inline Range departures_into(const Range& halves, Tick duration) {
  return {halves.first / 2 + 1 - duration, (halves.last - 1) >> 1};
}

/// Tick at which the robot entered the edge, or arrived at the vertex.
inline Tick enter_tick(const Occupation& occupation) {
  return occupation.begin / 2;
}
/// Tick at which it leaves the edge (or departs from the vertex).
inline Tick leave_tick(const Occupation& occupation) {
  return (occupation.end + 1) / 2;
}

}  // namespace mrpbench::mapf
