#include "mrpbench_mapf/cbs/target.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

/// The last half-tick at which `passing`, which got in the way of one that stands at `target` by `conflict`, is still.
Half last_in_way(const Space& space, const Situation& situation, const Conflict& conflict, int parked, int passing) {
  const std::span<const Occupation> path = situation.path(passing).occupied;
  if (conflict.resource < 0) {
    const int target = situation.path(parked).end();
    const double reach = space.instance().reach(parked, passing);
    Half last = conflict.time;
    for (const Occupation& it : path) {
      if (it.end < conflict.time) continue;
      if (space.relations().between(it.element, target, reach) != Relation::exclusive) break;
      last = it.end;
    }
    return last;
  }
  for (const Use& it : uses(space.instance(), path)) {
    if (it.resource == conflict.resource && it.halves.last >= conflict.time) return it.halves.last;
  }
  return kForeverHalf;
}

}  // namespace

std::optional<std::array<Constraint, 2>> resolve_at_target(const Space& space, const Situation& situation,
                                                           const Conflict& conflict, int parked, int passing) {
  Tick tick = conflict.time / 2;
  if (!space.textbook()) {
    // The last tick from which on the one that stands would still be in the way.
    const Half last = last_in_way(space, situation, conflict, parked, passing);
    if (last == kForeverHalf) return std::nullopt;
    tick = last / 2;
  }
  using Kind = Constraint::Kind;
  const int target = situation.path(parked).end();
  return std::array{Constraint{parked, target, {tick, tick}, Kind::finish_after},
                    Constraint{parked, target, {tick, tick}, Kind::finish_by}};
}

std::array<Constraint, 2> resolve_at_targets(const Situation& situation, const Conflict& conflict) {
  const auto never = [&](int robot) {
    return Constraint{robot, situation.path(robot).end(), {kForever, kForever}, Constraint::Kind::finish_after};
  };
  return {never(conflict.one), never(conflict.other)};
}

}  // namespace mrpbench::mapf
