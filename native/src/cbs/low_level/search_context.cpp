#include "mrpbench_mapf/cbs/low_level/search_context.hpp"

#include <algorithm>

#include "mrpbench_mapf/infeasibility/solvability.hpp"

namespace mrpbench::mapf {

namespace {

constexpr std::int64_t kMddBytes = 256 << 20;  // diagrams are quickly rebuilt

}  // namespace

SearchContext::SearchContext(const Instance& instance, const CbsOptions& options, Limits& limits,
                             Statistics& statistics)
    : options(options),
      limits(limits),
      statistics(statistics),
      space(instance, limits),
      distances(instance, limits),
      intervals(space, limits, statistics),
      search(space, intervals, limits, statistics),
      table(space, limits),
      scratch(space, limits),
      builder_(space, limits),
      mdds_(limits, static_cast<std::size_t>(std::min(kMddBytes, limits.memory_left() / 4))) {
  if (!instance.resources().empty()) soft_intervals.emplace(space, limits, statistics);
}

Tick SearchContext::least_cost(const NodeState& state, int robot) {
  if (state.least(robot) >= state.path(robot).cost) return state.path(robot).cost;
  Key name = state.key(robot);
  name += key_of({robot, 0, {0, 0}});
  const auto place = least_cost_.find(name);
  if (place != least_cost_.end()) return place->second;
  state.load(robot, table);
  const Tick cost = intervals.least_cost(table, distance_to_goal(robot, state.path(robot).goal));
  least_cost_.emplace(name, cost);
  limits.charge_growth(counted_, least_cost_.size() * (sizeof(Key) + 40));
  return cost;
}

std::shared_ptr<const Mdd> SearchContext::mdd(const NodeState& state, int robot) {
  const Tick cost = least_cost(state, robot);
  return mdds_.get(robot, state.key(robot), cost, [&] {
    state.load(robot, table);
    return builder_.build(table, distance_to_goal(robot, state.path(robot).goal), cost);
  });
}

bool SearchContext::costs_more(const NodeState& state, int robot, std::span<const Constraint> constraints) {
  if (space.classical() && constraints.size() == 1 && constraints[0].kind == Constraint::Kind::avoid &&
      constraints[0].element < space.vertex_count() && constraints[0].range.first == constraints[0].range.last) {
    return mdd(state, robot)->always_at(constraints[0].element, constraints[0].range.first / 2);
  }
  if (space.classical()) return mdd(state, robot)->blocked_by(constraints, scratch);
  // Where moves take many ticks a diagram is large, and a search among intervals is short.
  state.load(robot, table);
  table.add(constraints);
  return intervals.least_cost(table, distance_to_goal(robot, state.path(robot).goal)) > least_cost(state, robot);
}

DistanceTable& SearchContext::distance_to_goal(int robot, int goal) {
  return goal == TimedPath::kAnyGoal ? distances[robot] : distance_to(robot, goal);
}

DistanceTable& SearchContext::distance_to(int robot, int vertex) {
  const int profile = space.instance().robots()[robot].profile;
  auto& place = distance_to_[static_cast<std::int64_t>(profile) * space.vertex_count() + vertex];
  if (!place)
    place = std::make_unique<DistanceTable>(space.instance().roadmap(), profile, std::span(&vertex, 1), limits);
  return *place;
}

Candidates find_candidates(SearchContext& context) {
  const Instance& instance = context.space.instance();
  return list_candidates(instance, context.limits, [&](int robot, int goal) {
    return context.distance_to(robot, goal)(instance.beginning(robot).vertex);
  });
}

std::optional<int> prove_infeasible(SearchContext& context) {
  const Instance& instance = context.space.instance();
  if (const auto robot = find_cut_off_robot(instance, context.distances, context.limits)) return robot;
  if (context.space.classical() && !context.space.committed()) return find_shared_place(instance, context.limits);
  return find_clash(instance, context.space.relations(), context.limits);
}

}  // namespace mrpbench::mapf
