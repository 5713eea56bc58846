// Finds the segments near a point without looking at all of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_sim/geometry.hpp"

namespace mrpbench::sim {

/// Squares of the plane, each with the segments that come within `reach` of any point in it.
class SegmentBuckets {
 public:
  /// `cell` is the side of the squares; it is enlarged where the world would need too many.
  SegmentBuckets(std::span<const Segment> segments, double reach, double cell);

  /// Indices in ascending order of all segments within `reach` of a point, and of some that are farther.
  std::span<const std::int32_t> near(Point point) const;

 private:
  Point origin_;
  double cell_;
  std::int64_t columns_ = 0, rows_ = 0;
  std::vector<std::int64_t> first_{0};
  std::vector<std::int32_t> segments_;
};

}  // namespace mrpbench::sim
