// Objects in one scan that neither the map nor the other robots of the fleet explain.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_sim/frames.hpp"
#include "mrpbench_sim/segment_buckets.hpp"
#include "mrpbench_tracking/options.hpp"

namespace mrpbench::tracking {

using sim::Point;
using sim::Pose;
using sim::Segment;

/// The walls of the map.
struct Map {
  Map(std::vector<Segment> walls, double reach) : segments(std::move(walls)), buckets(segments, reach, 1.0) {}
  std::vector<Segment> segments;
  sim::SegmentBuckets buckets;
};

/// A disc that does not count, as it is a robot of the fleet.
struct Disc {
  Point centre;
  double radius = 0;
};

struct Detection {
  Point centre;
  /// Indices of the beams that end on it.
  std::vector<std::size_t> beams;
};

/// A scan, taken at `pose` by a lidar at `mount` in the frame of the robot; beam i points at i * 2*pi / beams from
/// straight ahead.
struct Scan {
  Pose pose;
  Point mount;
  std::span<const double> ranges;
};

/// The objects in a scan, in the order of their first beams. Consecutive points that are close make a segment (the
/// jump-distance segmentation of range scans: K. O. Arras, O. M. Mozos and W. Burgard, "Using boosted features for the
/// detection of people in 2D range data", ICRA 2007), and segments that together are no larger than an object make one,
/// nearest first. A disc is fitted to each segment: its diameter is the width that is seen, and its centre as far
/// behind the mean of the points as that of a disc which parallel beams hit, pi/4 radii.
std::vector<Detection> detect(const Scan& scan, const Map& map, std::span<const Disc> robots, const Options& options);

}  // namespace mrpbench::tracking
