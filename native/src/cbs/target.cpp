#include "mrpbench_mapf/cbs/target.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

/// The last half-tick at which the robot on `path` has its part in `conflict`.
Half last_in_way(const Space& space, std::span<const Occupation> path, const Conflict& conflict) {
  if (conflict.resource < 0) {
    return std::ranges::find_if(path, [&](const Occupation& it) { return it.end >= conflict.time; })->end;
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
    const Half last = last_in_way(space, situation.path(passing).occupied, conflict);
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
