#include "mrpbench_mapf/cbs/target.hpp"

#include <algorithm>

namespace mrpbench::mapf {

std::optional<std::array<Constraint, 2>> resolve_at_target(const Space& space, const Situation& situation,
                                                           const Conflict& conflict, int parked, int passing) {
  const std::vector<int>& goals = space.instance().robots()[parked].goals;
  if (goals.size() > 1) return std::nullopt;
  Tick tick = conflict.time / 2;
  if (!space.textbook()) {
    // The last tick from which on the one that stands would still be in the way.
    const std::span<const Occupation> occupied = situation.path(passing).occupied;
    const auto now = std::ranges::find_if(occupied, [&](const Occupation& it) { return it.end >= conflict.time; });
    if (now->end == kForeverHalf) return std::nullopt;
    tick = now->end / 2;
  }
  using Kind = Constraint::Kind;
  return std::array{Constraint{parked, goals[0], {tick, tick}, Kind::finish_after},
                    Constraint{parked, goals[0], {tick, tick}, Kind::finish_by}};
}

}  // namespace mrpbench::mapf
