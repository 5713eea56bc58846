// Prioritised planning: one robot after another, each around those before it.
// Erdmann and Lozano-Perez, "On multiple moving objects", Algorithmica 1987; Silver, "Cooperative Pathfinding",
// AIIDE 2005. After a failure the robot that found no path plans first the next time: Andreychuk and Yakovlev, "Two
// techniques that enhance the performance of multi-robot prioritized path planning", AAMAS 2018. After a hundred
// restarts robots also start late at random, and are hurried once there is a plan.
#pragma once

#include "mrpbench_mapf/limits.hpp"

namespace mrpbench::mapf {

enum class Order { index, longest_first, shortest_first, random };

struct PrioritizedOptions {
  Order order = Order::longest_first;
  int restarts = 0;  // further orders to try after a failure
  std::uint64_t seed = 0;
};

Result solve_prioritized(const Instance& instance, const PrioritizedOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
