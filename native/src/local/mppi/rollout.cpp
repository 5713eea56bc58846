#include "mrpbench_local/mppi/rollout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "mrpbench_local/wide.hpp"

namespace mrpbench::local::mppi {

namespace {

/// Sine and cosine, to 2e-7, without branches (polynomials: S. L. Moshier, Cephes, 1992).
inline void sine_cosine(float angle, float& sine, float& cosine) {
  const auto quarter = static_cast<std::int32_t>(angle * 0.636619772f + (angle < 0 ? -0.5f : 0.5f));
  const auto n = static_cast<float>(quarter);
  const float r = ((angle - n * 1.5703125f) - n * 4.8351287841796875e-4f) - n * 3.13855707645416259765625e-7f;
  const float z = r * r;
  const float s = ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * r + r;
  const float c =
      ((2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z - 0.5f * z + 1.0f;
  const bool odd = (quarter & 1) != 0;
  const auto number = static_cast<std::uint32_t>(quarter);
  const std::uint32_t sign_s = (number & 2) << 30, sign_c = ((number + 1) & 2) << 30;
  sine = std::bit_cast<float>(std::bit_cast<std::uint32_t>(odd ? c : s) ^ sign_s);
  cosine = std::bit_cast<float>(std::bit_cast<std::uint32_t>(odd ? s : c) ^ sign_c);
}

/// Fetch a row into the cache before it is needed. The noise of a fleet does not fit there.
void fetch(const float* row, std::size_t count) {
  constexpr std::size_t line = 64 / sizeof(float);
  for (std::size_t k = 0; k < count; k += line) __builtin_prefetch(row + k);
}

/// The velocities of step t, which follow the controls of the step before, and the poses, by Euler's method with the
/// yaw before the step.
MRPBENCH_WIDE void take_step(std::size_t t, const Sampling& by, Tables& out) {
  const std::size_t count = out.length.size();
  const float *const noise_vx = by.noise.vx_of(t - 1), *const noise_wz = by.noise.wz_of(t - 1);
  const float centre_vx = by.vx[t - 1], centre_wz = by.wz[t - 1], dt = by.dt;
  const Change change = by.change;
  const float *const from_vx = out.vx[t - 1], *const from_wz = out.wz[t - 1];
  const float *const from_x = out.x[t - 1], *const from_y = out.y[t - 1], *const from_yaw = out.yaw[t - 1];
  float *const vx = out.vx[t], *const wz = out.wz[t], *const x = out.x[t], *const y = out.y[t], *const yaw = out.yaw[t];
  float* const length = out.length.data();
  MRPBENCH_NO_OVERLAP
  for (std::size_t k = 0; k < count; ++k) {
    const float wanted_vx = centre_vx + noise_vx[k], wanted_wz = centre_wz + noise_wz[k];
    const bool forward = from_vx[k] > 0;
    const float up = forward ? change.speed_up : change.slow_down;
    const float down = forward ? change.slow_down : change.speed_up;
    const float ahead = std::min(std::max(wanted_vx, from_vx[k] - down), from_vx[k] + up);
    const float turn = std::min(std::max(wanted_wz, from_wz[k] - change.turn), from_wz[k] + change.turn);
    vx[k] = ahead;
    wz[k] = turn;
    float sine, cosine;
    sine_cosine(from_yaw[k], sine, cosine);
    const float step = ahead * dt;
    x[k] = from_x[k] + step * cosine;
    y[k] = from_y[k] + step * sine;
    yaw[k] = from_yaw[k] + turn * dt;
    length[k] += std::abs(ahead) * dt;
  }
}

}  // namespace

void roll_out(const Sampling& by, Tables& out) {
  const std::size_t steps = out.vx.steps, count = out.length.size();
  const auto fill = [count](float* row, float value) { std::fill_n(row, count, value); };
  fill(out.vx[0], by.start_vx);
  fill(out.wz[0], by.start_wz);
  fill(out.x[0], by.start_vx * by.dt);
  fill(out.y[0], 0);
  fill(out.yaw[0], by.start_wz * by.dt);
  fill(out.length.data(), std::abs(by.start_vx) * by.dt);
  for (std::size_t t = 1; t < steps; ++t) {
    fetch(by.noise.vx_of(t), count);
    fetch(by.noise.wz_of(t), count);
    take_step(t, by, out);
  }
}

}  // namespace mrpbench::local::mppi
