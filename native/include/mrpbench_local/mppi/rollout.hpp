// The arithmetic of MPPI on tables of samples, so that the compiler vectorises it. Sums over samples have a fixed
// order.
#pragma once

#include <array>
#include <span>

#include "mrpbench_local/mppi/batch.hpp"

namespace mrpbench::local::mppi {

/// What one step may change: `speed_up` and `slow_down` are positive, metres per second; `turn` in radians per second.
struct Change {
  float speed_up = 0, slow_down = 0, turn = 0;
};

/// Sine and cosine, to 2e-7, without branches (polynomials: S. L. Moshier, Cephes, 1992).
void sine_cosine(const float* angle, float* sine, float* cosine, std::size_t count);

/// Velocities that follow controls within accelerations: row 0 is the start, row t follows control t - 1.
void limit(const Table& wanted_vx, const Table& wanted_wz, float vx, float wz, Change change, Table& out_vx,
           Table& out_wz);

/// Poses by velocities from (0, 0, 0); row t is at the end of step t.
void roll_out(const Table& vx, const Table& wz, float dt, Table& x, Table& y, Table& yaw);

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
