#include "lacam/configurations.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "mrpbench_mapf/infeasibility/solvability.hpp"

namespace mrpbench::mapf::lacam {

std::vector<std::int32_t> goals_of(const Instance& instance) {
  std::vector<std::int32_t> goals;
  for (const Robot& robot : instance.robots()) goals.push_back(robot.goals.front());
  return goals;
}

bool prove_unsolvable(const Instance& instance, DistanceTables& tables, Limits& limits, Result& result) {
  std::optional<int> culprit = find_cut_off_robot(instance, tables, limits);
  if (!culprit) culprit = find_shared_place(instance, limits);
  if (culprit) {
    result.no_plan_for(*culprit);
  } else {
    result.lower_bound = static_cast<double>(tables.sum_of_costs(instance));
  }
  return culprit.has_value();
}

std::vector<std::int32_t> first_order(const Instance& instance, DistanceTables& tables) {
  std::vector<std::int32_t> order(instance.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater{},
                           [&](int robot) { return tables[robot](instance.robots()[robot].start); });
  return order;
}

void next_order(const std::vector<std::int32_t>& goals, Configuration at, const std::int32_t* order,
                const std::vector<std::int32_t>& first, std::int32_t* next) {
  const auto arrived = [&](std::int32_t robot) { return at[robot] == goals[robot]; };
  for (std::size_t k = 0; k < goals.size(); ++k) {
    if (!arrived(order[k])) *next++ = order[k];
  }
  for (const std::int32_t robot : first) {
    if (arrived(robot)) *next++ = robot;
  }
}

bool is_goal(const std::vector<std::int32_t>& goals, Configuration at) {
  return std::equal(goals.begin(), goals.end(), at);
}

std::vector<Path> paths_of(const Moves& moves, const std::vector<Configuration>& sequence, int robots) {
  const auto ticks = static_cast<Tick>(sequence.size());
  std::vector<Path> paths(robots);
  for (int robot = 0; robot < robots; ++robot) {
    Path& path = paths[robot];
    path.push_back(at_vertex(sequence.front()[robot], 0, 0));
    for (Tick tick = 0; tick + 1 < ticks; ++tick) {
      const std::int32_t tail = sequence[tick][robot], head = sequence[tick + 1][robot];
      if (tail == head) continue;
      path.back().end = 2 * tick;
      path.push_back(on_edge(moves.vertex_count() + moves.edge(tail, head), tick, tick + 1));
      path.push_back(at_vertex(head, tick + 1, tick + 1));
    }
    path.back().end = kForeverHalf;
  }
  return paths;
}

}  // namespace mrpbench::mapf::lacam
