#include "mrpbench_mapf/cbs/target.hpp"

#include <algorithm>

namespace mrpbench::mapf {

std::optional<std::array<Constraint, 2>> resolve_at_target(const Space& space, const Situation& situation,
                                                           const Conflict& conflict, int parked, int passing) {
  Tick tick = conflict.time / 2;
  if (!space.textbook()) {
    // The last tick from which on the one that stands would still be in the way.
    const std::span<const Occupation> occupied = situation.path(passing).occupied;
    const auto now = std::ranges::find_if(occupied, [&](const Occupation& it) { return it.end >= conflict.time; });
    if (now->end == kForeverHalf) return std::nullopt;
    tick = now->end / 2;
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
