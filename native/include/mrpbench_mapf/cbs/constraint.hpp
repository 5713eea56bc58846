// The constraints by which conflict-based search resolves conflicts.
#pragma once

#include <array>

#include "mrpbench_mapf/conflict.hpp"

namespace mrpbench::mapf {

/// What `robot` must not do, or (finish_by) must.
struct Constraint {
  enum class Kind : std::int32_t {
    avoid,         // a vertex at the half-ticks `range`, or entering an edge at the ticks `range`
    finish_after,  // if its last move ends at the vertex `element`, then later than tick `range.first`
    finish_by,     // its last move ends at the vertex `element`, at tick `range.first` at the latest: no other robot
                   // may be in the way of one that stands there from that tick on
    keep_off,      // the resource `element`: must not use it at the half-ticks `range`
    keep_clear,    // the crossing at the vertex `element`: must be nowhere on it at the half-ticks `range`
  };
  std::int32_t robot;
  std::int32_t element;
  Range range;
  Kind kind = Kind::avoid;

  bool operator==(const Constraint&) const = default;
};

/// `robot` must not be at `vertex` at any instant from tick `first` to `last`, nor between them.
inline Constraint avoid_vertex(int robot, int vertex, Tick first, Tick last) {
  return {robot, vertex, {2 * first, last >= kForever ? kForeverHalf : 2 * last}};
}

/// `robot` must be nowhere on the crossing at `vertex` at the half-tick `instant`.
inline Constraint keep_clear(int robot, int vertex, Half instant) {
  return {robot, vertex, {instant, instant}, Constraint::Kind::keep_clear};
}

/// Two constraints, one for each robot, at least one of which every solution keeps: whatever the one forbids conflicts
/// with whatever the other forbids. Both forbid what the robots now do.
///
/// The ranges of departures are those of Andreychuk et al., "Multi-agent pathfinding with continuous time", AIJ 2022,
/// in integer time; standing is constrained by instants, so that no wait without an end has to be reasoned about.
std::array<Constraint, 2> split(const PairConflict& conflict, std::span<const Occupation> one,
                                std::span<const Occupation> other, int vertex_count);

}  // namespace mrpbench::mapf
