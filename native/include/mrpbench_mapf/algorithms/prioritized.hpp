// Prioritised planning: one robot after another, each around those before it.
// Erdmann and Lozano-Perez, "On multiple moving objects", Algorithmica 1987; Silver, "Cooperative Pathfinding",
// AIIDE 2005. After a failure the robot that found no path plans first the next time: Andreychuk and Yakovlev, "Two
// techniques that enhance the performance of multi-robot prioritized path planning", AAMAS 2018. After a hundred
// restarts robots also start late at random; once there is a plan, each is given its earliest path in it.
#pragma once

#include "mrpbench_mapf/model/result.hpp"
#include "mrpbench_options/options.hpp"

namespace mrpbench::mapf {

enum class Order { index, longest_first, shortest_first, random };

struct PrioritizedOptions {
  Order order = Order::longest_first;
  int restarts = 1000;
  std::uint64_t seed = 0;

  static Description<PrioritizedOptions> description() {
    return {
        {"order", &PrioritizedOptions::order,
         Choices<Order>{{"index", Order::index},
                        {"longest_first", Order::longest_first},
                        {"shortest_first", Order::shortest_first},
                        {"random", Order::random}},
         "Which robots plan first: index (the order of the fleet), longest_first or shortest_first (by the distance "
         "to the goal), random"},
        {"restarts", &PrioritizedOptions::restarts, at_least(0), "Further orders to try after a failure"},
        {"seed", &PrioritizedOptions::seed, "Seed of random orders and late starts"}};
  }
};

Result solve_prioritized(const Instance& instance, const PrioritizedOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
