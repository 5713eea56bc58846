// The least sum of arrival times over all paths from start to goal in a graph of configurations. A step's share in it
// depends on which robots will still move, so the search runs backwards: over configurations with the set of robots
// that move after them.
#pragma once

#include "lacam/configuration_graph.hpp"

namespace mrpbench::mapf::lacam {

inline constexpr int kMostRobotsInSet = 64;

/// A way of less than `bound`, or an empty one if there is none. For at most `kMostRobotsInSet` robots.
std::vector<Configuration> least_arrivals(const ConfigurationGraph& graph, const Node& start, const Node& goal,
                                          int robots, Cost bound, Limits& limits);

}  // namespace mrpbench::mapf::lacam
