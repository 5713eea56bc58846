// A scan as points in the frame of the robot.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_sim/frames.hpp"

namespace mrpbench::slam {

using sim::composed;
using sim::Point;
using sim::Pose;
using sim::relative;
using sim::wrapped;

/// What a lidar is, and which of its ranges are used; metres.
struct Lidar {
  double range = 0, min_range = 0;
  Point mount;
};

/// A return, and the direction across the surface that it lies on: a unit vector, or zero if it is unknown.
struct Return {
  Point point, normal;
};

struct Scan {
  /// Where the beams begin.
  Point origin;
  /// Where those end that return within the range.
  std::vector<Point> hits;
  /// Where those end that do not: at the range. A beam whose neighbours return was lost, and is left out.
  std::vector<Point> misses;
  /// Evenly spaced returns for matching.
  std::vector<Return> returns;

  /// Metres from the robot to the farthest return.
  double reach() const;
};

/// The points of a scan, of which at most `max_beams` returns are matched. A range below `min_range` says nothing. The
/// normal of a return is that of the line through its neighbours, if these are near.
Scan scan_of(std::span<const double> ranges, const Lidar& lidar, int max_beams);

inline Point placed(Pose pose, double c, double s, Point point) {
  return {pose.x + c * point.x - s * point.y, pose.y + s * point.x + c * point.y};
}

}  // namespace mrpbench::slam
