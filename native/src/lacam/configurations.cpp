#include "lacam/configurations.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mrpbench::mapf::lacam {

std::vector<std::int32_t> goals_of(const Instance& instance) {
  std::vector<std::int32_t> goals;
  for (const Robot& robot : instance.robots()) goals.push_back(robot.goals.front());
  return goals;
}

std::vector<std::int32_t> first_order(const Instance& instance, DistanceTables& tables) {
  std::vector<std::int32_t> order(instance.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int robot) {
    return std::pair(instance.robots()[robot].rank, -tables[robot](instance.beginning(robot).vertex));
  });
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

}  // namespace mrpbench::mapf::lacam
