// The constraints by which conflict-based search resolves a conflict, and how they bind one robot.
#pragma once

#include <array>

#include "mrpbench_mapf/conflict.hpp"
#include "mrpbench_mapf/reservations.hpp"

namespace mrpbench::mapf {

/// `robot` must not be at a vertex during half-ticks `range`, or must not enter an edge at ticks `range`.
struct Constraint {
  std::int32_t robot;
  std::int32_t element;
  Range range;
};

/// Two constraints, one for each robot, at least one of which every solution keeps: whatever the one forbids conflicts
/// with whatever the other forbids. Both forbid what the robots now do.
///
/// The ranges of departures are those of Andreychuk et al., "Multi-agent pathfinding with continuous time", AIJ 2022,
/// in integer time; standing is constrained by instants, so that no wait without an end has to be reasoned about.
std::array<Constraint, 2> split(const PairConflict& conflict, std::span<const Occupation> one,
                                std::span<const Occupation> other, int vertex_count);

/// The constraints of one robot, listed by element, and what the others do for certain.
class ConstraintTable final : public Obstacles {
 public:
  ConstraintTable(const Roadmap& roadmap, const Reservations& certain, Limits& limits);

  void reset(int robot);
  void add(const Constraint& constraint);
  void at_vertex(int vertex, std::vector<Range>& halves) const override;
  void on_edge(int edge, Tick duration, std::vector<Range>& departures) const override;

 private:
  struct Entry {
    Range range;
    std::int32_t next;
  };
  void list(int element, std::vector<Range>& ranges) const;

  const Reservations& certain_;
  int vertex_count_;
  int robot_ = -1;
  std::vector<std::int32_t> head_;  // by element, -1 = none
  std::vector<std::int32_t> touched_;
  std::vector<Entry> entries_;
};

}  // namespace mrpbench::mapf
