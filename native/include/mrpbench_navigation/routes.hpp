// The routes of a fleet as robots drive them, in tables. The navigator `waypoints` fills them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "mrpbench_sim/plane.hpp"

namespace mrpbench::navigation {

using sim::Point;
using sim::Pose;
using sim::Twist;
using Index = std::int64_t;

/// When a waypoint is reached: within a distance, or by passing it within another. NaN: passing does not count.
struct Arrival {
  double x = 0, y = 0, tolerance = 0, along_x = 0, along_y = 0, lateral_tolerance = 0;

  bool holds(double at_x, double at_y) const;
};

/// A corner is rounded on the far side of the line that bisects its angle. NaN: never.
struct Rounding {
  double x = 0, y = 0, normal_x = 0, normal_y = 0;

  bool holds(double at_x, double at_y) const;
};

/// A vertex is cleared at a distance at which any other robot fits there.
struct Clearing {
  double x = 0, y = 0, distance = 0;

  bool holds(double at_x, double at_y) const;
};

/// A straight leg: a start, the step from there, and its squared length.
struct Leg {
  double x = 0, y = 0, dx = 0, dy = 0, squared = 0;

  Point nearest(double at_x, double at_y) const;
};

/// Tables of n robots, W waypoints and C corners, robot after robot. A corner is a waypoint that differs from the one
/// before; leg i leads from corner i to corner i + 1. Corners are counted from the first one of their robot.
struct Routes {
  std::span<const Index> first, last, goal, first_corner, last_corner;  // n: first rows, and last ones from there
  std::span<const Index> corner;                                        // W: where each waypoint lies
  std::span<const std::int16_t> level;                                  // W
  std::span<const double> speed, yaw, waiting_yaw;                      // W: m/s from there on; NaN = any yaw
  std::span<const bool> is_wait;                                        // W
  std::span<const Arrival> arrival;                                     // W
  std::span<const Point> corners;                                       // C
  std::span<const Point> step;                                          // C: of each leg
  std::span<const Point> normal;                                        // C: of the rounding at the end of each leg
  std::span<const double> clearance;                                    // C: at which each corner is cleared
  std::span<const double> distance;                                     // C: metres along all legs
  std::span<const bool> is_short;                                       // C: no longer than the clearance
  std::span<const Index> stop, lift;  // C: the next corner at which a path ends, or a robot enters a lift
  bool any_yaw = true;                // no robot has to turn at the end of its path

  Leg leg(Index row) const {
    const auto [x, y] = corners[row];
    const auto [dx, dy] = step[row];
    return {x, y, dx, dy, std::max(dx * dx + dy * dy, 1e-300)};
  }
  /// Of the corner at the end of a leg that is not a robot's last one.
  Rounding rounding(Index row) const { return {corners[row + 1].x, corners[row + 1].y, normal[row].x, normal[row].y}; }
  Clearing clearing(Index row) const { return {corners[row].x, corners[row].y, clearance[row]}; }
};

/// The sign of `std::hypot(dx, dy) - bound`, of a bound that is not negative. The squares are compared, and the root is
/// taken only where they are about equal.
inline double beyond(double dx, double dy, double bound) {
  const double more = dx * dx + dy * dy - bound * bound;
  return std::abs(more) > 1e-6 ? more : std::hypot(dx, dy) - bound;
}

/// The remainder of a division that rounds down.
double modulo(double value, double by);

/// The angle between two yaws, from 0 to pi; NaN if one is NaN.
double angle_between(double yaw, double other);

}  // namespace mrpbench::navigation
