// Whether a robot fits at a pose.
#pragma once

#include "mrpbench_local/costmap/costmap.hpp"

namespace mrpbench::local {

/// Tell whether a robot of the costmap's footprint fits at a pose, as far as the costmap knows. A footprint given by a
/// radius is checked at its centre.
bool is_free(const Costmap& costmap, Pose pose, bool by_radius);

/// The highest cost along the outline of corners in the plane; nothing if one of them is outside the costmap.
std::optional<std::uint8_t> outline_cost(const Costmap& costmap, std::span<const Point> corners);

}  // namespace mrpbench::local
