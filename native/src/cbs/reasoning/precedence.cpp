#include "mrpbench_mapf/cbs/reasoning/precedence.hpp"

#include <algorithm>

namespace mrpbench::mapf {

/// Let L(r) be the last half-tick, setup included, at which robot r has a resource if it leaves it as early as it can.
///   Complete: if neither robot uses the resource at all, both constraints hold. Otherwise let `one` be the first to
///   enter. It has the resource at L(one) or later before it leaves it for the first time, so `other` enters later than
///   L(one) and keeps its constraint.
///   Progress: the present paths break both constraints, which is checked.
std::optional<std::array<Constraint, 2>> Precedence::resolve(const NodeState& state, const Conflict& conflict) {
  const int resource = conflict.resource;
  if (!may_pass(conflict.one, resource) || !may_pass(conflict.other, resource)) return std::nullopt;
  const Half one_left = earliest_left(state, conflict.one, resource);
  if (!enters_by(state, conflict.other, resource, one_left)) return std::nullopt;
  const Half other_left = earliest_left(state, conflict.other, resource);
  if (!enters_by(state, conflict.one, resource, other_left)) return std::nullopt;
  const auto after = [&](int robot, Half last) {
    return Constraint{robot, resource, {0, last}, Constraint::Kind::resource};
  };
  return std::array{after(conflict.one, other_left), after(conflict.other, one_left)};
}

/// Can the robot have left the resource only by a move that it is free to make? One that is under way may have used it
/// before, and one that disappears at its goal may end in it.
bool Precedence::may_pass(int robot, int resource) const {
  const Instance& instance = context_.space.instance();
  if (instance.beginning(robot).occupied.size() > 1) return false;
  return !instance.rules().disappear_at_goal || std::ranges::none_of(instance.robots()[robot].goals, [&](int goal) {
    return std::ranges::find(instance.resources_of(goal), resource) != instance.resources_of(goal).end();
  });
}

Half Precedence::earliest_left(const NodeState& state, int robot, int resource) {
  Exits& it = exits(robot, resource);
  state.load(robot, context_.table);
  const Tick tick = context_.intervals.earliest_exit(context_.table, *it.distance, it.inside);
  if (tick == kForever) return kForeverHalf;
  const std::int64_t last = 2 * (std::int64_t{tick} + context_.space.instance().resources()[resource].setup) - 1;
  return static_cast<Half>(std::min<std::int64_t>(last, kForeverHalf));
}

/// Tell whether the present path uses the resource at half-tick `last` or before.
bool Precedence::enters_by(const NodeState& state, int robot, int resource, Half last) const {
  return std::ranges::any_of(uses(context_.space.instance(), state.path(robot).occupied),
                             [&](const Use& it) { return it.resource == resource && it.halves.first <= last; });
}

Precedence::Exits& Precedence::exits(int robot, int resource) {
  const Instance& instance = context_.space.instance();
  const int profile = instance.robots()[robot].profile, vertices = instance.roadmap().vertex_count();
  const std::int64_t key = static_cast<std::int64_t>(profile) * instance.resources().size() + resource;
  Exits& it = exits_[key];
  if (it.distance) return it;
  context_.limits.charge(instance.roadmap().element_count());
  it.inside.assign(instance.roadmap().element_count(), false);
  for (const int element : instance.resources()[resource].elements) it.inside[element] = true;
  std::vector<int> ends;
  for (int edge = 0; edge < instance.roadmap().edge_count(); ++edge) {
    const int tail = instance.roadmap().tail(edge), head = instance.roadmap().head(edge);
    const bool leaves = it.inside[vertices + edge] ? !it.inside[head] : it.inside[tail] != 0;
    if (leaves) ends.push_back(tail);
  }
  it.distance = std::make_unique<DistanceTable>(instance.roadmap(), profile, ends, context_.limits);
  return it;
}

}  // namespace mrpbench::mapf
