#include "mrpbench_mapf/cbs/workbench.hpp"

#include <algorithm>

#include "mrpbench_mapf/solvability.hpp"

namespace mrpbench::mapf {

namespace {

constexpr std::int64_t kMddBytes = 256 << 20;  // diagrams are quickly made anew

}  // namespace

Workbench::Workbench(const Instance& instance, const CbsOptions& options, Limits& limits, Statistics& statistics)
    : options(options),
      limits(limits),
      statistics(statistics),
      space(instance, limits),
      distances(instance, limits),
      intervals(space, limits, statistics),
      astar(space, intervals, limits, statistics),
      table(space, limits),
      scratch(space, limits),
      builder_(space, limits),
      mdds_(limits, static_cast<std::size_t>(std::min(kMddBytes, limits.memory_left() / 4))) {}

bool Workbench::plan(const Situation& situation, int robot, int goal, std::span<const Constraint> more,
                     const AvoidanceTable* others, FoundPath& path) {
  situation.load(robot, goal, table);
  table.add(more);
  return astar.search(table, distance_to_goal(robot, goal), others, path);
}

Tick Workbench::least_cost(const Situation& situation, int robot) {
  if (situation.least(robot) >= situation.path(robot).cost) return situation.path(robot).cost;
  Key name = situation.key(robot);
  name += key_of({robot, 0, {0, 0}});
  const auto place = least_cost_.find(name);
  if (place != least_cost_.end()) return place->second;
  situation.load(robot, table);
  const Tick cost = intervals.least_cost(table, distance_to_goal(robot, situation.path(robot).goal));
  least_cost_.emplace(name, cost);
  limits.charge_growth(counted_, least_cost_.size() * (sizeof(Key) + 40));
  return cost;
}

std::shared_ptr<const Mdd> Workbench::mdd(const Situation& situation, int robot) {
  const Tick cost = least_cost(situation, robot);
  return mdds_.get(robot, situation.key(robot), cost, [&] {
    situation.load(robot, table);
    return builder_.build(table, distance_to_goal(robot, situation.path(robot).goal), cost);
  });
}

bool Workbench::costs_more(const Situation& situation, int robot, std::span<const Constraint> constraints) {
  if (space.textbook() && constraints.size() == 1 && constraints[0].kind == Constraint::Kind::avoid &&
      constraints[0].element < space.vertex_count() && constraints[0].range.first == constraints[0].range.last) {
    return mdd(situation, robot)->always_at(constraints[0].element, constraints[0].range.first / 2);
  }
  if (space.textbook()) return mdd(situation, robot)->blocked_by(constraints, scratch);
  // Where moves take many ticks a diagram is large, and a search among intervals is short.
  situation.load(robot, table);
  table.add(constraints);
  return intervals.least_cost(table, distance_to_goal(robot, situation.path(robot).goal)) >
         least_cost(situation, robot);
}

DistanceTable& Workbench::distance_to_goal(int robot, int goal) {
  return goal == TimedPath::kAnyGoal ? distances[robot] : distance_to(robot, goal);
}

DistanceTable& Workbench::distance_to(int robot, int vertex) {
  const int profile = space.instance().robots()[robot].profile;
  auto& place = distance_to_[static_cast<std::int64_t>(profile) * space.vertex_count() + vertex];
  if (!place)
    place = std::make_unique<DistanceTable>(space.instance().roadmap(), profile, std::span(&vertex, 1), limits);
  return *place;
}

Candidates find_candidates(Workbench& bench) {
  const Instance& instance = bench.space.instance();
  return list_candidates(instance, bench.limits, [&](int robot, int goal) {
    return bench.distance_to(robot, goal)(instance.beginning(robot).vertex);
  });
}

std::optional<int> find_hopeless(Workbench& bench) {
  const Instance& instance = bench.space.instance();
  if (const auto robot = find_cut_off_robot(instance, bench.distances, bench.limits)) return robot;
  if (bench.space.textbook() && !bench.space.committed()) return find_shared_place(instance, bench.limits);
  return find_clash(instance, bench.space.relations(), bench.limits);
}

}  // namespace mrpbench::mapf
