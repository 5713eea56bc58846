// Sequences of configurations: all robots' vertices, tick by tick.
#pragma once

#include "lacam/moves.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf::lacam {

using Configuration = const std::int32_t*;  // vertex by robot

std::vector<std::int32_t> goals_of(const Instance& instance);

/// Set `result` to unsolvable if a robot cannot reach its goal, or two share a start or goal; else set the lower bound.
bool prove_unsolvable(const Instance& instance, DistanceTables& tables, Limits& limits, Result& result);

/// Robots in the order in which they first plan their next step: those farthest from their goals first.
std::vector<std::int32_t> first_order(const Instance& instance, DistanceTables& tables);

/// The order after a step: robots at their goals go behind all others, in `first` order.
void next_order(const std::vector<std::int32_t>& goals, Configuration at, const std::int32_t* order,
                const std::vector<std::int32_t>& first, std::int32_t* next);

bool is_goal(const std::vector<std::int32_t>& goals, Configuration at);

/// A sequence from start to goal as paths.
std::vector<Path> paths_of(const Moves& moves, const std::vector<Configuration>& sequence, int robots);

}  // namespace mrpbench::mapf::lacam
