// Conflicts on roadmaps of unit moves, and the constraints that resolve them.
#pragma once

#include <array>
#include <vector>

#include "mrpbench_mapf/bounded/path_table.hpp"
#include "mrpbench_mapf/bounded/unit_constraints.hpp"

namespace mrpbench::mapf {

/// `one` arrives at (or stands at) `vertex` at `time`. So does `other`, or, if `from` is not -1, `one` comes from there
/// and `other` goes there.
struct UnitConflict {
  std::int32_t one, other;
  std::int32_t vertex, from;
  Tick time;
};

/// Append the conflicts of `steps` with all paths in the table, which must not contain `robot` itself.
void find_conflicts(int robot, Steps steps, const PathTable& table, std::vector<UnitConflict>& found);

/// What resolves a conflict, or half of it.
struct UnitConstraint {
  enum Kind : std::int8_t {
    vertex,   // `robot` must not be at `to` at `ticks`
    move,     // `robot` must not arrive at `to` from `from` at `ticks`
    arrival,  // `robot` must arrive for good within `ticks`; others must not be at its goal `to` from the last of them
              // on
  };
  Kind kind;
  std::int32_t robot;
  std::int32_t from, to;
  Range ticks;

  /// Does it bind this robot?
  bool concerns(int it) const { return it == robot || (kind == arrival && ticks.last != kForever); }
  void apply(int it, UnitConstraints& constraints) const;
  /// Does this path of `it` keep the constraint?
  bool holds(int it, Steps steps) const;
};

/// Two constraints at least one of which every solution keeps, and neither of which both present paths keep.
std::array<UnitConstraint, 2> split(const UnitConflict& conflict);
/// The same for a robot that passes the goal of another that has arrived there before: either the other arrives later
/// than the conflict, or nobody passes from then on. Li, Harabor, Stuckey, Ma, Gange and Koenig, "Pairwise symmetry
/// reasoning for multi-agent path finding search", AIJ 2021.
std::array<UnitConstraint, 2> split_at_target(const UnitConflict& conflict, int arrived);

}  // namespace mrpbench::mapf
