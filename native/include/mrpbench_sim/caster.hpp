// A planar lidar among segments and discs. Each wall and disc updates only the beams within the angle that it covers,
// in closed form; the exact test of the core's `kinematic` simulator decides at the ends of that angle.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mrpbench_sim/plane.hpp"
#include "mrpbench_sim/segment_buckets.hpp"
#include "mrpbench_sim/team.hpp"

namespace mrpbench::sim {

/// What lidars see of robots in place of discs: the sides of robot i, in its own frame and solid on their left, are
/// `sides[first[i]]` to `sides[first[i + 1] - 1]`. All lie within the robot's disc. Without `first`, robots are discs.
struct Outlines {
  std::span<const Segment> sides;
  std::span<const int> first;
};

struct Lidar {
  int beams = 360;
  double range = 3.5, min_range = 0.12;
  /// Of the sensor in the robot's frame.
  Point mount;
};

class Caster {
 public:
  /// `threads` share the lidars of a scan; results do not depend on their number.
  Caster(std::vector<Segment> segments, const Lidar& lidar, int threads = 1);

  /// Ranges in metres of the lidars of `scanning`, row by row; infinity = no return. `centres` and `radius` are those
  /// of all discs, of which the first are the robots; none sees itself. `leaves` are solid besides the segments.
  void scan(std::span<const int> scanning, std::span<const Pose> poses, std::vector<Point> centres,
            std::span<const double> radius, std::span<const Segment> leaves, const Outlines& outlines,
            std::span<double> ranges) {
    begin(scanning, poses, std::move(centres), radius, leaves, outlines, ranges, nullptr);
    finish();
  }
  /// The same in two calls, between which the other threads go on; `owner` keeps what is passed until `finish`.
  void begin(std::span<const int> scanning, std::span<const Pose> poses, std::vector<Point> centres,
             std::span<const double> radius, std::span<const Segment> leaves, const Outlines& outlines,
             std::span<double> ranges, std::shared_ptr<const void> owner);
  void finish() { team_.finish(); }

  int beams() const { return lidar_.beams; }

 private:
  struct Wall {
    Point start, along;
    double reach;  // (range * length)^2
  };
  struct Scene;
  /// Beams first, first + 1, ..., which may be negative or more than there are.
  struct Span {
    long first, count;
  };

  Wall wall(const Segment& segment) const;
  std::vector<Wall> placed(const Outlines& outlines, std::span<const Pose> poses) const;
  void see_wall(const Wall& wall, Point origin, Point facing, double* nearness) const;
  void see_disc(Point offset, double radius, Point facing, double* nearness) const;
  Span between(Point right, Point left) const;
  std::size_t beam(long index) const;

  Lidar lidar_;
  std::vector<Wall> walls_;
  SegmentBuckets buckets_;
  std::vector<double> cosine_, sine_;
  double per_radian_, padding_;
  long edge_;
  Team team_;
};

}  // namespace mrpbench::sim
