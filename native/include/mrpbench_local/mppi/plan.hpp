// How MPPI makes a plan of weighted samples. Sums over samples have a fixed order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mrpbench_local/mppi/batch.hpp"

namespace mrpbench::local::mppi {

/// How far the controls of samples are from a plan in one step, on one axis: unit * row[k] each.
struct NoiseRow {
  const std::int16_t* row = nullptr;
  float unit = 1;
};
using NoiseRows = std::span<const NoiseRow>;

/// The same by the velocities that follow: row[k] - plan each.
struct VelocityRow {
  const float* row = nullptr;
  float plan = 0;
};
using VelocityRows = std::span<const VelocityRow>;

/// The sum of weights, of which the last ones are 0 so that their number is a multiple of `kBlock`.
float sum(std::span<const float> weights);
/// Add to a plan, step by step, the sum over the samples of a block of weight * deviation. Weights of noise are
/// rounded to 1/32767 of their sum, so that sums are exact in any order: the mean of 256 samples with equal weights is
/// off by 1.4e-4 standard deviations, less than a hundredth of what it is off by chance.
void add_weighted(std::span<const float> weights, NoiseRows steps, std::span<float> plan);
void add_weighted(std::span<const float> weights, VelocityRows steps, std::span<float> plan);

/// Add what the deviations of samples cost: `per[t]` each in step t.
void add_deviations(NoiseRows steps, std::span<const float> per, std::span<float> total);
void add_deviations(VelocityRows steps, std::span<const float> per, std::span<float> total);

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
