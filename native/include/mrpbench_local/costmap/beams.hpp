// The cells in which the beams of a scan end.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "mrpbench_local/costmap/grid.hpp"

namespace mrpbench::local {

/// The beams of one scan; beam i points at i * 2*pi / size from straight ahead.
class Beams {
 public:
  /// Point `count` beams from a sensor that is turned by `yaw`.
  void aim(std::size_t count, Point origin, double yaw);

  std::size_t size() const { return along_x_.size(); }
  Point end(std::size_t i, double length) const { return origin_ + Point{along_x_[i], along_y_[i]} * length; }

  /// The first of the beams that may come within `off` of a point, metres, and how many follow in turn: no others do.
  std::pair<std::size_t, std::size_t> around(Point p, double off) const;

  /// Shorten each of the lengths, metres, so that it ends at the border of the frame, in which the sensor is.
  void clip(const Frame& frame, std::span<double> lengths) const;
  /// The cells at the ends of beams of these lengths.
  void end_cells(const Frame& frame, std::span<const double> lengths, std::span<Cell> cells) const;

 private:
  Point origin_;
  double yaw_ = 0;
  std::vector<double> ahead_x_, ahead_y_, along_x_, along_y_;  // unit vectors in the sensor's frame, and in the world's
};

}  // namespace mrpbench::local
