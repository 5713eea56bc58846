// Robots that cannot get through a chain because too few vertices are empty. A chain is a path of bridges whose inner
// vertices have no other neighbours, without the ends that lie on cycles. Robots in it keep their order, and as robots
// come and go, a side of it that is full takes in only as many as left it: if no more vertices are empty than the chain
// has, no robot gets from one side to the other. So three sets never change: the robots that are on one side
// or would be if it were full, those of the other side, and the sequence of those between. It is the passage through
// isthmuses of Kornhauser, Miller and Spirakis, "Coordinating pebble motion on graphs, the diameter of permutation
// groups, and applications", FOCS 1984, with cycles that turn even when they are full, as in Yu and Rus, "Pebble motion
// on graphs with rotations: Efficient feasibility tests and planning algorithms", WAFR 2014.
#pragma once

#include <optional>
#include <span>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/instance.hpp"

namespace mrpbench::mapf {

/// A robot whose goal is beyond a chain that it cannot get through, or nothing. `vertices` are a connected part of the
/// roadmap, `robots` those that start and end in it, each at a vertex of its own. Disregards the direction of edges;
/// every move has to take one tick.
std::optional<int> find_robot_beyond_chain(const Instance& instance, std::span<const int> vertices,
                                           std::span<const int> robots, Limits& limits);

}  // namespace mrpbench::mapf
