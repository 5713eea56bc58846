// The outline of a robot on a raster.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_local/costmap/grid.hpp"

namespace mrpbench::local {

/// Moved outward by `padding` along both axes, as Nav2 pads footprints.
std::vector<Point> padded(std::span<const Point> footprint, double padding);

/// A regular polygon of 16 corners, as Nav2 makes a footprint of a radius.
std::vector<Point> rounded(double radius);

/// Distance of the outline from the origin, where it is nearest.
double inscribed_radius(std::span<const Point> footprint);

/// Corners in the plane.
void place(std::span<const Point> footprint, Pose pose, std::vector<Point>& corners);

/// Tell whether a point lies inside a polygon (even-odd rule).
bool inside(std::span<const Point> polygon, Point p);

}  // namespace mrpbench::local
