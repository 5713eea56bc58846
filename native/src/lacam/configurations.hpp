// Configurations: the vertices of all robots.
#pragma once

#include "lacam/moves.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf::lacam {

using Configuration = const std::int32_t*;  // vertex by robot

std::vector<std::int32_t> goals_of(const Instance& instance);

/// Robots in the order in which they first plan their next step: by rank, of one rank those that are farthest from
/// their goals first.
std::vector<std::int32_t> first_order(const Instance& instance, DistanceTables& tables);

/// The order after a step: robots at their goals go behind all others, in `first` order.
void next_order(const std::vector<std::int32_t>& goals, Configuration at, const std::int32_t* order,
                const std::vector<std::int32_t>& first, std::int32_t* next);

bool is_goal(const std::vector<std::int32_t>& goals, Configuration at);

}  // namespace mrpbench::mapf::lacam
