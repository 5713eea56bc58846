#include "mrpbench_mapf/cbs/reasoning/reasoning.hpp"

namespace mrpbench::mapf {

void Reasoning::examine(const NodeState& state, Conflict& conflict) {
  if (conflict.examined) return;
  conflict.examined = true;
  if (context_.options.target && examine_target(state, conflict)) return;
  rate(state, conflict);
  if (conflict.resource >= 0) {
    if (context_.options.precedence) examine_precedence(state, conflict);
    return;
  }
  if (context_.options.prioritize) examine_junction(state, conflict);
  if (context_.options.corridor && examine_corridor(state, conflict)) return;
  if (context_.options.rectangle && context_.space.classical()) examine_rectangle(state, conflict);
}

bool Reasoning::examine_target(const NodeState& state, Conflict& conflict) {
  if (conflict.one_stays != conflict.other_stays) return examine_passing(state, conflict);
  if (!conflict.one_stays) return false;
  use(conflict, Conflict::Kind::target, resolve_at_targets(state, conflict));
  rate(state, conflict);
  return true;
}

bool Reasoning::examine_passing(const NodeState& state, Conflict& conflict) {
  const int parked = conflict.one_stays ? conflict.one : conflict.other;
  const int passing = conflict.one_stays ? conflict.other : conflict.one;
  if (context_.options.corridor && conflict.resource < 0 && examine_corridor_to(state, conflict, passing, parked)) {
    return true;
  }
  const auto branches = resolve_at_target(context_.space, state, conflict, parked, passing);
  if (!branches) return false;
  use(conflict, Conflict::Kind::target, *branches);
  if (context_.options.prioritize) {
    const int rising = context_.costs_more(state, parked, conflict.branch[0]) +
                       context_.costs_more(state, passing, conflict.branch[1]);
    conflict.cardinality = static_cast<Conflict::Cardinality>(rising);
  }
  return true;
}

/// Forbid robots a junction at an earlier instant, if more of the branches then cost more. A robot that has waited on
/// the junction needlessly can leave it before the instant of the conflict, and its branch costs nothing; the instant
/// used here is the last at which one of them must still be on the junction, even on its quickest path.
void Reasoning::examine_junction(const NodeState& state, Conflict& conflict) {
  const Constraint present = conflict.branch[0][0];
  if (present.kind != Constraint::Kind::junction || conflict.cardinality == Conflict::Cardinality::both) return;
  if (present.range.first < conflict.time) return;  // one would leave before the other one comes
  for (const int robot : {conflict.one, conflict.other}) {
    const Half instant = earliest_done(state, conflict, robot, present.element);
    if (instant < conflict.time || instant >= present.range.first) continue;
    Conflict sooner = conflict;
    const Range window = window_from(instant, context_.space.instance().rules().k);
    use(sooner, conflict.kind,
        {junction_constraint(conflict.one, present.element, window),
         junction_constraint(conflict.other, present.element, window)});
    rate(state, sooner);
    if (sooner.cardinality > conflict.cardinality) conflict = sooner;
  }
}

/// The last half-tick at which `robot` is on `junction` if it takes the quickest path to where it leaves; or
/// kForeverHalf.
Half Reasoning::earliest_done(const NodeState& state, const Conflict& conflict, int robot, int junction) {
  const std::span<const Occupation> path = state.path(robot).occupied;
  auto step = std::ranges::find_if(path, [&](const Occupation& it) { return it.end >= conflict.time; });
  while (step != path.end() && context_.space.meets(step->element, junction)) ++step;
  if (step == path.end()) return kForeverHalf;
  // A robot that leaves by an edge comes to a vertex.
  state.load(robot, context_.table);
  const Tick tick = context_.intervals.earliest(context_.table, context_.distance_to(robot, step->element),
                                                step->element, enter_tick(*step));
  return tick == kForever ? kForeverHalf : 2 * tick - 1;
}

bool Reasoning::examine_corridor(const NodeState& state, Conflict& conflict) {
  const bool pseudo = conflict.cardinality == Conflict::Cardinality::both;
  if (const auto branches = corridors_.resolve(state, conflict, pseudo)) {
    use(conflict, Conflict::Kind::corridor, *branches);
    rate(state, conflict);
    return true;
  }
  if (!context_.options.target) return false;
  for (const auto& [passing, ending] : {std::pair(conflict.one, conflict.other), {conflict.other, conflict.one}}) {
    Conflict there = conflict;
    if (!examine_corridor_to(state, there, passing, ending)) continue;
    if (context_.options.prioritize && there.cardinality <= conflict.cardinality) continue;
    conflict = there;
    return true;
  }
  return false;
}

/// Use a corridor that leads `passing` through the end of `ending`.
bool Reasoning::examine_corridor_to(const NodeState& state, Conflict& conflict, int passing, int ending) {
  const auto found = corridors_.resolve_at_target(state, conflict, passing, ending);
  if (!found) return false;
  const std::span<const Constraint> first(&found->ending, 1), second(found->passing);
  const bool in_order = ending == conflict.one;
  use(conflict, Conflict::Kind::target, in_order ? first : second, in_order ? second : first);
  rate(state, conflict);
  return true;
}

void Reasoning::examine_rectangle(const NodeState& state, Conflict& conflict) {
  const bool at_vertex = conflict.time % 2 == 0;
  if (!at_vertex || conflict.one_stays || conflict.other_stays || conflict.cardinality == Conflict::Cardinality::both) {
    return;
  }
  const auto one = context_.mdd(state, conflict.one), other = context_.mdd(state, conflict.other);
  if (!rectangles_.resolve(*one, state.path(conflict.one), *other, state.path(conflict.other), conflict.one_element,
                           conflict.time / 2)) {
    return;
  }
  use(conflict, Conflict::Kind::rectangle, rectangles_.one_branch(), rectangles_.other_branch());
  rate(state, conflict);
}

void Reasoning::examine_precedence(const NodeState& state, Conflict& conflict) {
  const auto branches = precedence_.resolve(state, conflict);
  if (!branches) return;
  use(conflict, Conflict::Kind::precedence, std::span(&(*branches)[0], 1), std::span(&(*branches)[1], 1));
  rate(state, conflict);
}

void Reasoning::rate(const NodeState& state, Conflict& conflict) {
  if (!context_.options.prioritize) return;
  const int rising = context_.costs_more(state, conflict.one, conflict.branch[0]) +
                     context_.costs_more(state, conflict.other, conflict.branch[1]);
  conflict.cardinality = static_cast<Conflict::Cardinality>(rising);
}

void Reasoning::use(Conflict& conflict, Conflict::Kind kind, std::span<const Constraint> one,
                    std::span<const Constraint> other) {
  conflict.kind = kind;
  conflict.branch = {constraints_.copy(one), constraints_.copy(other)};
}

}  // namespace mrpbench::mapf
