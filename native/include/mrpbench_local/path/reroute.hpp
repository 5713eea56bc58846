// Ways on the costmap: around what blocks a path, or to a place.
#pragma once

#include <optional>
#include <vector>

#include "mrpbench_local/costmap/costmap.hpp"
#include "mrpbench_local/path/path_grid.hpp"

namespace mrpbench::local {

/// Points around what blocks a path, at most `farthest` metres (along rows and columns) from it, to a point of the path
/// beyond; nothing when the path is free as far as the map shows, or there is no such way.
std::optional<std::vector<Point>> reroute(const Costmap& costmap, Point robot, Point first, std::span<const Point> rest,
                                          double farthest);

/// Points to the place nearest to the end of a path, at most `tolerance` metres from it, when the end itself is
/// occupied; nothing when it is free, or there is no such way. As Nav2's global planner with its parameter `tolerance`.
std::optional<std::vector<Point>> approach(const Costmap& costmap, Point robot, Point first,
                                           std::span<const Point> rest, double farthest, double tolerance);

/// Points from the robot along the cheapest way to a place, over all cells that the map does not show as occupied;
/// where there is none, to the nearest reachable cell at most `tolerance` metres from the place, with room around it.
/// As NavFn of Nav2, with A* and a shortened way. Nothing when there is no way.
std::optional<std::vector<Point>> plan(const Costmap& costmap, Point robot, Point goal, double tolerance);

}  // namespace mrpbench::local
