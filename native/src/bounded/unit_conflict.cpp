#include "mrpbench_mapf/bounded/unit_conflict.hpp"

namespace mrpbench::mapf {

void find_conflicts(int robot, Steps steps, const PathTable& table, std::vector<UnitConflict>& found) {
  const auto last = static_cast<Tick>(steps.size()) - 1;
  for (Tick tick = 1; tick <= last; ++tick) {
    const std::int32_t from = steps[tick - 1], to = steps[tick];
    table.visitors(to, tick, [&](int other) { found.push_back({robot, other, to, -1, tick}); });
    if (from == to) continue;
    table.swappers(from, to, tick - 1, [&](int other) { found.push_back({robot, other, to, from, tick}); });
  }
  for (Tick tick = last + 1; tick < table.ticks(); ++tick) {
    table.visitors(steps[last], tick, [&](int other) { found.push_back({robot, other, steps[last], -1, tick}); });
  }
}

void UnitConstraint::apply(int it, UnitConstraints& constraints) const {
  switch (kind) {
    case vertex:
      constraints.forbid_vertex(to, ticks);
      break;
    case move:
      constraints.forbid_move(from, to, ticks);
      break;
    case arrival:
      if (it == robot) {
        constraints.limit_arrival(ticks);
      } else {
        constraints.forbid_vertex(to, {ticks.last, kForever});
      }
      break;
  }
}

bool UnitConstraint::holds(int it, Steps steps) const {
  const auto size = static_cast<Tick>(steps.size());
  const auto visits = [&](Range during) {
    if (steps.back() == to && during.last >= size) return true;
    for (Tick tick = during.first; tick < size && tick <= during.last; ++tick) {
      if (steps[tick] == to && (kind != move || (tick > 0 && steps[tick - 1] == from))) return true;
    }
    return false;
  };
  if (kind != arrival) return !visits(ticks);
  if (it == robot) return size - 1 >= ticks.first && size - 1 <= ticks.last;
  return !visits({ticks.last, kForever});
}

std::array<UnitConstraint, 2> split(const UnitConflict& conflict) {
  const auto& [one, other, to, from, tick] = conflict;
  const Range now{tick, tick};
  if (from < 0) {
    return {UnitConstraint{UnitConstraint::vertex, one, -1, to, now},
            UnitConstraint{UnitConstraint::vertex, other, -1, to, now}};
  }
  return {UnitConstraint{UnitConstraint::move, one, from, to, now},
          UnitConstraint{UnitConstraint::move, other, to, from, now}};
}

std::array<UnitConstraint, 2> split_at_target(const UnitConflict& conflict, int arrived) {
  const auto constraint = [&](Range ticks) {
    return UnitConstraint{UnitConstraint::arrival, arrived, -1, conflict.vertex, ticks};
  };
  return {constraint({conflict.time + 1, kForever}), constraint({0, conflict.time})};
}

}  // namespace mrpbench::mapf
