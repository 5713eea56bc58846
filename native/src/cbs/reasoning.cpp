#include "mrpbench_mapf/cbs/reasoning.hpp"

namespace mrpbench::mapf {

void Reasoning::examine(const Situation& situation, Conflict& conflict) {
  if (conflict.examined) return;
  conflict.examined = true;
  if (bench_.options.target && examine_target(situation, conflict)) return;
  rate(situation, conflict);
  if (conflict.resource >= 0) return;
  if (bench_.options.prioritize) examine_crossing(situation, conflict);
  if (bench_.options.corridor && examine_corridor(situation, conflict)) return;
  if (bench_.options.rectangle && bench_.space.textbook()) examine_rectangle(situation, conflict);
}

bool Reasoning::examine_target(const Situation& situation, Conflict& conflict) {
  if (conflict.one_stays != conflict.other_stays) return examine_passing(situation, conflict);
  if (!conflict.one_stays) return false;
  const auto branches = resolve_at_targets(situation, conflict);
  use(conflict, Conflict::Kind::target, std::span(&branches[0], 1), std::span(&branches[1], 1));
  rate(situation, conflict);
  return true;
}

bool Reasoning::examine_passing(const Situation& situation, Conflict& conflict) {
  const int parked = conflict.one_stays ? conflict.one : conflict.other;
  const int passing = conflict.one_stays ? conflict.other : conflict.one;
  if (bench_.options.corridor && conflict.resource < 0 && examine_corridor_to(situation, conflict, passing, parked)) {
    return true;
  }
  const auto branches = resolve_at_target(bench_.space, situation, conflict, parked, passing);
  if (!branches) return false;
  use(conflict, Conflict::Kind::target, std::span(&(*branches)[0], 1), std::span(&(*branches)[1], 1));
  if (bench_.options.prioritize) {
    const int rising = bench_.costs_more(situation, parked, conflict.branch[0]) +
                       bench_.costs_more(situation, passing, conflict.branch[1]);
    conflict.cardinality = static_cast<Conflict::Cardinality>(rising);
  }
  return true;
}

/// Keep robots clear of a crossing at an earlier instant, if more of them then cost more: at the last at which one of
/// them must still be on it, however much it hurries.
void Reasoning::examine_crossing(const Situation& situation, Conflict& conflict) {
  const Constraint present = conflict.branch[0][0];
  if (present.kind != Constraint::Kind::keep_clear || conflict.cardinality == Conflict::Cardinality::both) return;
  for (const int robot : {conflict.one, conflict.other}) {
    const Half instant = earliest_done(situation, conflict, robot, present.element);
    if (instant < conflict.time || instant >= present.range.first) continue;
    Conflict sooner = conflict;
    const std::array branches{keep_clear(conflict.one, present.element, instant),
                              keep_clear(conflict.other, present.element, instant)};
    use(sooner, conflict.kind, std::span(&branches[0], 1), std::span(&branches[1], 1));
    rate(situation, sooner);
    if (sooner.cardinality > conflict.cardinality) conflict = sooner;
  }
}

/// The half-tick at which `robot`, if it hurried to where it leaves `crossing`, would be on it last; or kForeverHalf.
Half Reasoning::earliest_done(const Situation& situation, const Conflict& conflict, int robot, int crossing) {
  const std::span<const Occupation> path = situation.path(robot).occupied;
  auto step = std::ranges::find_if(path, [&](const Occupation& it) { return it.end >= conflict.time; });
  while (step != path.end() && bench_.space.meets(step->element, crossing)) ++step;
  if (step == path.end()) return kForeverHalf;
  // Whoever leaves by an edge comes out at a vertex.
  situation.load(robot, bench_.table);
  const Tick tick = bench_.intervals.earliest(bench_.table, bench_.distance_to(robot, step->element), step->element,
                                              enter_tick(*step));
  return tick == kForever ? kForeverHalf : 2 * tick - 1;
}

bool Reasoning::examine_corridor(const Situation& situation, Conflict& conflict) {
  const bool pseudo = conflict.cardinality == Conflict::Cardinality::both;
  if (const auto branches = corridors_.resolve(situation, conflict, pseudo)) {
    use(conflict, Conflict::Kind::corridor, std::span(&(*branches)[0], 1), std::span(&(*branches)[1], 1));
    rate(situation, conflict);
    return true;
  }
  if (!bench_.options.target) return false;
  for (const auto& [passing, ending] : {std::pair(conflict.one, conflict.other), {conflict.other, conflict.one}}) {
    Conflict there = conflict;
    if (!examine_corridor_to(situation, there, passing, ending)) continue;
    if (bench_.options.prioritize && there.cardinality <= conflict.cardinality) continue;
    conflict = there;
    return true;
  }
  return false;
}

/// Use a corridor that leads `passing` through the end of `ending`.
bool Reasoning::examine_corridor_to(const Situation& situation, Conflict& conflict, int passing, int ending) {
  const auto found = corridors_.resolve_at_target(situation, conflict, passing, ending);
  if (!found) return false;
  const std::span<const Constraint> first(&found->ending, 1), second(found->passing);
  const bool in_order = ending == conflict.one;
  use(conflict, Conflict::Kind::target, in_order ? first : second, in_order ? second : first);
  rate(situation, conflict);
  return true;
}

void Reasoning::examine_rectangle(const Situation& situation, Conflict& conflict) {
  const bool at_vertex = conflict.time % 2 == 0;
  if (!at_vertex || conflict.one_stays || conflict.other_stays || conflict.cardinality == Conflict::Cardinality::both) {
    return;
  }
  const auto one = bench_.mdd(situation, conflict.one), other = bench_.mdd(situation, conflict.other);
  if (!rectangles_.resolve(*one, situation.path(conflict.one), *other, situation.path(conflict.other),
                           conflict.one_element, conflict.time / 2)) {
    return;
  }
  use(conflict, Conflict::Kind::rectangle, rectangles_.one_branch(), rectangles_.other_branch());
  rate(situation, conflict);
}

void Reasoning::rate(const Situation& situation, Conflict& conflict) {
  if (!bench_.options.prioritize) return;
  const int rising = bench_.costs_more(situation, conflict.one, conflict.branch[0]) +
                     bench_.costs_more(situation, conflict.other, conflict.branch[1]);
  conflict.cardinality = static_cast<Conflict::Cardinality>(rising);
}

void Reasoning::use(Conflict& conflict, Conflict::Kind kind, std::span<const Constraint> one,
                    std::span<const Constraint> other) {
  conflict.kind = kind;
  conflict.branch = {constraints_.copy(one), constraints_.copy(other)};
}

}  // namespace mrpbench::mapf
