// How MPPI makes a plan of weighted samples. Sums over samples have a fixed order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mrpbench_local/mppi/batch.hpp"

namespace mrpbench::local::mppi {

/// How far the controls of samples are from a plan in one step, on one axis: unit * row[k] - plan each. The rows are
/// noise, or velocities.
template <class T>
struct Deviations {
  const T* row = nullptr;
  float unit = 1, plan = 0;
};
using NoiseRows = std::span<const Deviations<std::int16_t>>;
using VelocityRows = std::span<const Deviations<float>>;

/// The sum of weights, of which the last ones are 0 so that their number is a multiple of `kBlock`.
float sum(std::span<const float> weights);
/// Add to a plan, step by step, the sum over samples of weight * deviation.
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
