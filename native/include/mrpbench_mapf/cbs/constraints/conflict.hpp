// A conflict in a node of the constraint tree, and how it may be resolved.
#pragma once

#include <array>

#include "mrpbench_mapf/cbs/constraints/avoidance_table.hpp"
#include "mrpbench_mapf/cbs/constraints/constraint.hpp"
#include "mrpbench_mapf/cbs/constraints/space.hpp"

namespace mrpbench::mapf {

struct Conflict {
  /// By what reasoning the branches were made.
  enum class Kind : std::int8_t { standard, rectangle, corridor, precedence, target };
  /// How many of the branches cost more than the node: none, one, both (Boyarski et al., IJCAI 2015).
  enum class Cardinality : std::int8_t { none, semi, both };

  std::int32_t one, other;                  // robots
  std::int32_t one_element, other_element;  // where they are: a vertex, or vertex_count + edge
  Half time;                                // first half-tick of the conflict
  bool one_stays, other_stays;              // at its goal for good
  std::int32_t resource = -1;               // that both use, if that is the conflict
  bool examined = false;                    // are the following known?
  Kind kind = Kind::standard;
  Cardinality cardinality = Cardinality::none;
  /// Constraints of which every solution keeps all of the one or all of the other; the present paths keep neither.
  std::array<std::span<const Constraint>, 2> branch = {};
};

/// Append all conflicts of the path of `robot` with those of others in `present` to `found`, with the standard
/// branches. `constraints` keeps the constraints.
void find_conflicts(const Space& space, const AvoidanceTable& present, int robot, const TimedPath& path,
                    Arena<Constraint>& constraints, std::vector<Conflict>& found);

/// Tell whether `robot` is in the way of the robot that `parked` (a `length_at_most`) keeps at its goal.
bool stands_in_way(const Space& space, int robot, const TimedPath& path, const Constraint& parked);

/// Tell whether the path of `robot` violates one of `constraints`, which forbid parts of the present paths.
bool breaks(const Space& space, int robot, const TimedPath& path, std::span<const Constraint> constraints);

}  // namespace mrpbench::mapf
