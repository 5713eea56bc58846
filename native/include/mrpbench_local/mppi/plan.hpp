// How MPPI makes a plan of weighted samples. Sums over samples have a fixed order.
#pragma once

#include <array>
#include <span>
#include <utility>

#include "mrpbench_local/mppi/batch.hpp"

namespace mrpbench::local::mppi {

/// The speeds, or turn rates, that samples want in one step: `base` + row[k] each.
struct Controls {
  float base = 0;
  const float* row = nullptr;

  float operator[](std::size_t k) const { return base + row[k]; }
};

/// The sum over samples, of values or of weight * value.
float sum(const float* values, std::size_t count);
float weighted_sum(const float* weights, const float* values, std::size_t count);
/// The sums of weight * control, of speeds and turn rates.
std::pair<float, float> weighted_sums(const float* weights, Controls vx, Controls wz, std::size_t count);

/// Add what the differences between controls and a plan cost: `per_vx` and `per_wz` each.
void add_deviation(Controls vx, Controls wz, float plan_vx, float plan_wz, float per_vx, float per_wz,
                   std::span<float> total);

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
