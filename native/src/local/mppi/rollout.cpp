#include "mrpbench_local/mppi/rollout.hpp"

#include <algorithm>
#include <array>
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

/// An angle by which robots turn in one step can be so small that two terms of the series of sine and cosine give them
/// to 1e-7. A heading that is turned by 56 such angles, one after the other, is off by 1e-6 at most.
constexpr float kSmall = 0.2f;

/// Turn a heading by a small angle.
inline void turn_by(float angle, float& sine, float& cosine) {
  const float z = angle * angle;
  const float s = ((8.3333333e-3f * z - 1.6666667e-1f) * z + 1) * angle, c = (4.1666667e-2f * z - 0.5f) * z + 1;
  const float before = sine;
  sine = before * c + cosine * s;
  cosine = cosine * c - before * s;
}

/// How one axis gets to the velocities of a step: from those of a step before, by at most `up` and `down` (for speeds
/// below zero the other way round), to a control and its noise, in units.
struct Follow {
  float centre = 0, unit = 0;
  const std::int16_t* noise = nullptr;
  const float* from = nullptr;
  float up = 0, down = 0;
};

/// A command on its way decides its step, whatever the drive did before. The first control counts from the start.
Follow followed(std::size_t t, std::span<const float> sent, std::span<const float> centre, const Noise& noise,
                const Rows<std::int16_t>& rows, const Table& velocities, Follow within) {
  constexpr float any = std::numeric_limits<float>::infinity();
  if (t <= sent.size()) return {sent[t - 1], 0, rows[0], velocities[0], any, any};
  const std::size_t control = t - 1 - sent.size();
  within.centre = centre[control];
  within.noise = rows[noise.row(control)];
  within.from = velocities[control == 0 ? 0 : t - 1];
  return within;
}

/// The velocities and poses of all steps but the first, by Euler's method with the yaw before each step.
MRPBENCH_WIDE void take_steps(const std::vector<std::pair<Follow, Follow>>& steps, float dt, bool by_small_angles,
                              Tables& out) {
  const std::size_t count = out.length.size();
  float* const length = out.length.data();
  std::array<float, kBlock> sine, cosine;  // of the yaw before a step
  for (std::size_t k = 0; k < count; ++k) sine_cosine(out.yaw[0][k], sine[k], cosine[k]);
  float *const sines = sine.data(), *const cosines = cosine.data();
  for (std::size_t t = 1; t <= steps.size(); ++t) {
    const auto [ahead, turn] = steps[t - 1];
    const float *const from_x = out.x[t - 1], *const from_y = out.y[t - 1], *const from_yaw = out.yaw[t - 1];
    float *const vx = out.vx[t], *const wz = out.wz[t], *const x = out.x[t], *const y = out.y[t];
    float* const yaw = out.yaw[t];
    const auto each = [=](auto&& turn_heading) {
      MRPBENCH_NO_OVERLAP
      for (std::size_t k = 0; k < count; ++k) {
        const float wanted_vx = ahead.centre + ahead.unit * static_cast<float>(ahead.noise[k]);
        const float wanted_wz = turn.centre + turn.unit * static_cast<float>(turn.noise[k]);
        const float from_vx = ahead.from[k], from_wz = turn.from[k];
        const float up = from_vx > 0 ? ahead.up : ahead.down, down = from_vx > 0 ? ahead.down : ahead.up;
        const float speed = std::min(std::max(wanted_vx, from_vx - down), from_vx + up);
        const float rate = std::min(std::max(wanted_wz, from_wz - turn.down), from_wz + turn.up);
        vx[k] = speed;
        wz[k] = rate;
        const float step = speed * dt, turned = rate * dt;
        x[k] = from_x[k] + step * cosines[k];
        y[k] = from_y[k] + step * sines[k];
        yaw[k] = from_yaw[k] + turned;
        turn_heading(turned, yaw[k], sines[k], cosines[k]);
        length[k] += std::abs(step);
      }
    };
    if (by_small_angles) {
      each([](float turned, float, float& its_sine, float& its_cosine) { turn_by(turned, its_sine, its_cosine); });
    } else {
      each([](float, float to, float& its_sine, float& its_cosine) { sine_cosine(to, its_sine, its_cosine); });
    }
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
  const Follow ahead{0, by.vx_std * Noise::kUnit, nullptr, nullptr, by.change.speed_up, by.change.slow_down};
  const Follow turn{0, by.wz_std * Noise::kUnit, nullptr, nullptr, by.change.turn, by.change.turn};
  std::vector<std::pair<Follow, Follow>> all;
  all.reserve(steps);
  for (std::size_t t = 1; t < steps; ++t) {
    all.emplace_back(followed(t, by.sent_vx, by.vx, by.noise, by.noise.vx, out.vx, ahead),
                     followed(t, by.sent_wz, by.wz, by.noise, by.noise.wz, out.wz, turn));
  }
  float fastest = std::abs(by.start_wz);
  for (const float rate : by.wz) fastest = std::max(fastest, std::abs(rate) + by.wz_std * Noise::kMost);
  for (const float rate : by.sent_wz) fastest = std::max(fastest, std::abs(rate));
  take_steps(all, by.dt, fastest * by.dt <= kSmall, out);
  std::copy_n(out.yaw[steps - 1], count, out.end_yaw.begin());
}

}  // namespace mrpbench::local::mppi
