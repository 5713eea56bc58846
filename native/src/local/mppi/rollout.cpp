#include "mrpbench_local/mppi/rollout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "mrpbench_common/wide.hpp"

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

/// How one axis gets to the velocities of a step: from those of a step before, by at most `up` and `down` (for speeds
/// below zero the other way round), to a control and its noise.
struct Follow {
  float centre = 0;
  const float *noise = nullptr, *from = nullptr;
  float up = 0, down = 0;
};

/// A command on its way decides its step, whatever the drive did before. The first control counts from the start.
Follow followed(std::size_t t, std::span<const float> sent, std::span<const float> centre, const Table& noise,
                std::size_t first, const Table& velocities, Follow within) {
  constexpr float any = std::numeric_limits<float>::infinity();
  if (t <= sent.size()) return {sent[t - 1], within.noise, velocities[0], any, any};
  const std::size_t control = t - 1 - sent.size();
  within.centre = centre[control];
  within.noise = noise[(control + first) % noise.steps];
  within.from = velocities[control == 0 ? 0 : t - 1];
  return within;
}

/// The velocities and poses of step t, by Euler's method with the yaw before the step.
MRPBENCH_WIDE void take_step(std::size_t t, Follow ahead, Follow turn, float dt, Tables& out) {
  const std::size_t count = out.length.size();
  const float *const from_x = out.x[t - 1], *const from_y = out.y[t - 1], *const from_yaw = out.yaw[t - 1];
  float *const vx = out.vx[t], *const wz = out.wz[t], *const x = out.x[t], *const y = out.y[t], *const yaw = out.yaw[t];
  float* const length = out.length.data();
  const auto each = [=](auto&& change) {
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < count; ++k) {
      const float wanted_vx = ahead.centre + ahead.noise[k], wanted_wz = turn.centre + turn.noise[k];
      const auto [up, down] = change(ahead.from[k]);
      const float speed = std::min(std::max(wanted_vx, ahead.from[k] - down), ahead.from[k] + up);
      const float rate = std::min(std::max(wanted_wz, turn.from[k] - turn.down), turn.from[k] + turn.up);
      vx[k] = speed;
      wz[k] = rate;
      float sine, cosine;
      sine_cosine(from_yaw[k], sine, cosine);
      const float step = speed * dt;
      x[k] = from_x[k] + step * cosine;
      y[k] = from_y[k] + step * sine;
      yaw[k] = from_yaw[k] + rate * dt;
      length[k] += std::abs(step);
    }
  };
  if (ahead.up == ahead.down) {
    each([=](float) { return std::pair{ahead.up, ahead.up}; });
  } else {
    each([=](float from) { return std::pair{from > 0 ? ahead.up : ahead.down, from > 0 ? ahead.down : ahead.up}; });
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
  const std::vector<float> none(by.sent_vx.empty() && by.sent_wz.empty() ? 0 : count);
  const Follow ahead{0, none.data(), nullptr, by.change.speed_up, by.change.slow_down};
  const Follow turn{0, none.data(), nullptr, by.change.turn, by.change.turn};
  for (std::size_t t = 1; t < steps; ++t) {
    fetch(by.noise.vx_of(t), count);
    fetch(by.noise.wz_of(t), count);
    take_step(t, followed(t, by.sent_vx, by.vx, by.noise.vx, by.noise.first, out.vx, ahead),
              followed(t, by.sent_wz, by.wz, by.noise.wz, by.noise.first, out.wz, turn), by.dt, out);
  }
}

}  // namespace mrpbench::local::mppi
