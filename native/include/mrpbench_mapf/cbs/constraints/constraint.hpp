// The constraints by which conflict-based search resolves conflicts.
#pragma once

#include <array>

#include "mrpbench_mapf/model/conflict.hpp"

namespace mrpbench::mapf {

/// What `robot` must not do, or (`length_at_most`) must do.
struct Constraint {
  enum class Kind : std::int32_t {
    avoid,           // a vertex at the half-ticks `range`, or entering an edge at the ticks `range`
    length_above,    // a path whose last move ends at the vertex `element` is longer than `range.first` ticks
    length_at_most,  // the last move ends at the vertex `element` at tick `range.first` at the latest, and no other
                     // robot is in the way of a robot that stands there from that tick on
    resource,        // does not use the resource `element` at the half-ticks `range`
    junction,        // is not on the junction at the vertex `element` at the half-ticks `range`
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

/// The half-ticks from `instant` to `k` ticks later: two robots that are each somewhere then are never farther apart in
/// time than robots may be late. Without delays this is the instant alone.
inline Range window_from(Half instant, Tick k) {
  return {instant, widened(instant, instant, k).last};
}

/// `robot` must not be on the junction at `vertex` (the vertex and its edges) at the half-ticks `range`.
inline Constraint junction_constraint(int robot, int vertex, Range range) {
  return {robot, vertex, range, Constraint::Kind::junction};
}

/// Two constraints, one for each robot, at least one of which every solution keeps: everything that one forbids
/// conflicts with everything that the other forbids. Both forbid the present paths.
///
/// The ranges of departures are those of Andreychuk et al., "Multi-agent pathfinding with continuous time", AIJ 2022,
/// in integer time; standing is constrained by instants, so that no wait without an end has to be reasoned about.
/// Robots that may be up to `k` ticks late are constrained by the ranges of Atzmon et al., JAIR 2020, instead of
/// instants.
std::array<Constraint, 2> split(const PairConflict& conflict, std::span<const Occupation> one,
                                std::span<const Occupation> other, int vertex_count, Tick k);

}  // namespace mrpbench::mapf
