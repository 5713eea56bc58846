#include "mrpbench_mapf/cbs/reasoning/target.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

/// The last half-tick of the steps during which `passing` is in the way of the robot that stands at its goal.
Half last_in_way(const Space& space, const NodeState& state, const Conflict& conflict, int parked, int passing) {
  const std::span<const Occupation> path = state.path(passing).occupied;
  if (conflict.resource < 0) {
    const int target = state.path(parked).end();
    const double reach = space.instance().reach(parked, passing);
    Half last = conflict.time;
    for (const Occupation& it : path) {
      if (it.end < conflict.time) continue;
      if (space.relations().between(it.element, target, reach) != Relation::exclusive) break;
      last = widened(it.begin, it.end, space.instance().rules().k).last;
    }
    return last;
  }
  for (const Use& it : uses(space.instance(), path)) {
    if (it.resource == conflict.resource && it.halves.last >= conflict.time) return it.halves.last;
  }
  return kForeverHalf;
}

}  // namespace

std::optional<std::array<Constraint, 2>> resolve_at_target(const Space& space, const NodeState& state,
                                                           const Conflict& conflict, int parked, int passing) {
  Tick tick = conflict.time / 2;
  if (!space.classical()) {
    // The split at t, "finishes later than t, or by t and then no robot is in its way", is right for any t: every plan
    // keeps one side. The largest t that forbids both present paths is the last tick of all successive steps by which
    // the other robot bars the goal.
    const Half last = last_in_way(space, state, conflict, parked, passing);
    if (last == kForeverHalf) return std::nullopt;
    tick = last / 2;
  }
  using Kind = Constraint::Kind;
  const int target = state.path(parked).end();
  return std::array{Constraint{parked, target, {tick, tick}, Kind::length_above},
                    Constraint{parked, target, {tick, tick}, Kind::length_at_most}};
}

std::array<Constraint, 2> resolve_at_targets(const NodeState& state, const Conflict& conflict) {
  const auto never = [&](int robot) {
    return Constraint{robot, state.path(robot).end(), {kForever, kForever}, Constraint::Kind::length_above};
  };
  return {never(conflict.one), never(conflict.other)};
}

}  // namespace mrpbench::mapf
