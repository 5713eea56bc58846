// A way on the costmap around what blocks a path.
#pragma once

#include <optional>
#include <vector>

#include "mrpbench_local/costmap.hpp"
#include "mrpbench_local/path_grid.hpp"

namespace mrpbench::local {

/// Tell whether a robot of the costmap's footprint fits at a pose, as far as the costmap knows. A footprint given by a
/// radius is looked up at its centre.
bool is_free(const Costmap& costmap, Pose pose, bool by_radius);

/// Points around what blocks a path, at most `farthest` metres (along rows and columns) from it, to a point of the path
/// beyond; nothing when the path is free as far as the map shows, or there is no such way.
std::optional<std::vector<Point>> reroute(const Costmap& costmap, Point robot, Point first, std::span<const Point> rest,
                                          double farthest);

}  // namespace mrpbench::local
