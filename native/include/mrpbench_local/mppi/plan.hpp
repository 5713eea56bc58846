// How MPPI makes a plan of weighted samples. Sums over samples have a fixed order.
#pragma once

#include <array>
#include <span>

#include "mrpbench_local/mppi/batch.hpp"

namespace mrpbench::local::mppi {

/// The sum over samples, of values or of weight * value.
float sum(const float* values, std::size_t count);
float weighted_sum(const float* weights, const float* values, std::size_t count);

/// Nine points Savitzky-Golay filter of second order, or the mean of nine points (order 1). Before `values` come the
/// four of `past`, after them the last one repeated; the last stays. Fewer than 21 values stay as they are.
void smooth(std::span<float> values, const std::array<float, 4>& past, int order);

/// Metres per second squared, both positive, and radians per second squared.
struct Accelerations {
  double speed_up = 0, slow_down = 0, turn = 0;
};

/// Keep a plan within limits and accelerations. It begins `period` seconds after the velocity `ahead`, `turn`; its
/// steps are `dt` seconds.
void constrain(std::span<float> vx, std::span<float> wz, const Limits& limits, const Accelerations& accelerations,
               double ahead, double turn, double period, double dt);

}  // namespace mrpbench::local::mppi
