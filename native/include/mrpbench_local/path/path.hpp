// The path that a controller follows.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mrpbench_local/costmap/grid.hpp"

namespace mrpbench::local {

/// A path in the plane, with yaw (NaN = any) and speed at its end.
struct Path {
  Point first;
  std::span<const Point> rest;
  double yaw = 0, speed = 0, tolerance = 0.1;

  Point end() const { return rest.empty() ? first : rest.back(); }
};

/// Tell whether a path leads to another place, or another yaw there, than `goal`, which may be that of the path before.
bool is_new(const std::optional<Pose>& goal, const Path& path);

/// The points of a path in the frame of a robot: x ahead, y to the left.
std::vector<Point> in_frame_of(Pose robot, const Path& path);

/// The rest of a polyline from the point that is nearest to the origin, among those in the first `search` metres.
std::vector<Point> from_nearest(std::span<const Point> points, double search);

/// Length of a polyline, in metres.
double length_of(std::span<const Point> points);

/// The point at `distance` metres along a polyline; beyond its end either its end, or that much farther straight on.
Point point_at(std::span<const Point> points, double distance, bool straight_on = false);

/// The first `length` metres of a polyline as points that are `spacing` metres apart. The end of the polyline is the
/// last point if it lies within `length`. There are at least two points.
std::vector<Point> resampled(std::span<const Point> points, double spacing, double length);

/// Angle in [-pi, pi].
double wrapped(double angle);

}  // namespace mrpbench::local
