// Where objects will be.
#pragma once

#include <vector>

#include "mrpbench_sim/walkers.hpp"

namespace mrpbench::tracking {

using sim::Point;
using sim::Segment;
using sim::Walker;

/// Places of objects at 0, step, 2 * step, ... seconds: row by row, `count` of each.
using Places = std::vector<Point>;

/// Objects keep their velocities.
Places by_constant_velocity(std::span<const Walker> objects, double step, std::size_t count);

/// Objects walk by social forces as people of `sim::Walkers` do, with its defaults, and want the velocities that they
/// have; `robots` with `robot_radius` stay where they are, and are regarded as people.
Places by_social_force(std::span<const Walker> objects, double radius, const std::vector<Segment>& walls,
                       std::span<const Point> robots, std::span<const double> robot_radius, double step,
                       std::size_t count);

}  // namespace mrpbench::tracking
