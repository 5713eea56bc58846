// Headings along the trajectories of one state, which all trajectories with the same turn rate and number of steps
// share.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "mrpbench_local/costmap/grid.hpp"

namespace mrpbench::local {

/// `speed` after `dt` on its way to `target`; `deceleration` is negative.
inline double project(double speed, double acceleration, double deceleration, double dt, double target) {
  if (speed < target) return std::min(target, speed + acceleration * dt);
  return std::max(target, speed + deceleration * dt);
}

/// Limits of a change of speed per second; deceleration is negative.
struct Limits {
  double acceleration = 0, deceleration = 0;
};

/// One column for each turn rate, so that several are computed at once.
class Turns {
 public:
  /// The number of columns that are computed at once.
  static constexpr std::size_t kBlock = 4;
  /// Limits of `estimate`: the turn of a trajectory, radians, and the steps in which rates and speeds change.
  static constexpr double kMostTurn = 5;
  static constexpr int kMostSteps = 32;

  /// Begin at a heading and a turn rate; without one, each column turns at its own from the beginning. Then all columns
  /// have 0 steps. The rates are used until the next call.
  void begin(double yaw, std::optional<double> rate, std::span<const double> rates);
  /// Give each column its number of steps, but at least `least`, that last `time` in all. The turn rate changes within
  /// the limits. Columns that have that many already stay.
  void step(std::span<const int> counts, int least, double time, Limits limits);

  /// The same but for rounding errors, without yaw, in less time: headings by polynomials, and sums over the steps at
  /// one turn rate in closed form. `changing`: steps from the first one in which speeds change. Returns false, in the
  /// middle of it, beyond the limits.
  bool estimate(std::span<const int> counts, int least, double time, Limits limits, int changing);

  /// The distances x, y of the last poses from the first one of trajectories of one speed, for each column: `now` is
  /// the speed at the first pose, `wanted` the one that is reached within the limits. Both have room for whole blocks.
  void drive(double now, double wanted, Limits limits, double* x, double* y) const;

  /// Of the last poses: yaw, and the unit vector along the heading.
  const double* yaw() const { return yaw_.data(); }
  const double* heading_x() const { return heading_x_.data(); }
  const double* heading_y() const { return heading_y_.data(); }

 private:
  void accelerate(std::size_t column, int count, double time, Limits limits);
  void spin(std::size_t column);
  bool estimate_block(std::size_t column, double time, Limits limits, int changing);
  std::size_t row(int k) const { return static_cast<std::size_t>(k) * stride_; }

  double first_yaw_ = 0;
  std::optional<double> first_rate_;
  Point first_heading_;
  std::span<const double> rates_;
  std::size_t stride_ = 0;  // columns, and more to make whole blocks
  std::vector<double> count_, dt_, yaw_, heading_x_, heading_y_;
  /// Sums of the unit vectors before each step: row k has those of the first k steps of each column, and `total` those
  /// of all its steps.
  std::vector<double> sum_x_, sum_y_, total_x_, total_y_;
  /// Columns have taken the steps before `from`. All others turn by the same angle, which has this unit vector.
  std::vector<double> from_, angle_, by_x_, by_y_;
};

}  // namespace mrpbench::local
