#include "mrpbench_local/mppi/rollout.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mrpbench_local/wide.hpp"

namespace mrpbench::local::mppi {

MRPBENCH_WIDE void sine_cosine(const float* angle, float* sine, float* cosine, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const float a = angle[k];
    const auto quarter = static_cast<std::int32_t>(a * 0.636619772f + (a < 0 ? -0.5f : 0.5f));
    const auto n = static_cast<float>(quarter);
    const float r = ((a - n * 1.5703125f) - n * 4.8351287841796875e-4f) - n * 3.13855707645416259765625e-7f;
    const float z = r * r;
    const float s = ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * r + r;
    const float c =
        ((2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z - 0.5f * z + 1.0f;
    const bool odd = (quarter & 1) != 0;
    const float sign_s = static_cast<float>(1 - (quarter & 2));
    const float sign_c = static_cast<float>(1 - ((quarter + 1) & 2));
    sine[k] = (odd ? c : s) * sign_s;
    cosine[k] = (odd ? s : c) * sign_c;
  }
}

MRPBENCH_WIDE void limit(const Table& wanted_vx, const Table& wanted_wz, float vx, float wz, Change change,
                         Table& out_vx, Table& out_wz) {
  const std::size_t count = wanted_vx.samples;
  std::fill_n(out_vx[0], count, vx);
  std::fill_n(out_wz[0], count, wz);
  for (std::size_t t = 1; t < wanted_vx.steps; ++t) {
    const float *from = out_vx[t - 1], *wanted = wanted_vx[t - 1];
    float* to = out_vx[t];
    for (std::size_t k = 0; k < count; ++k) {
      const bool forward = from[k] > 0;
      const float up = forward ? change.speed_up : change.slow_down;
      const float down = forward ? change.slow_down : change.speed_up;
      to[k] = std::min(std::max(wanted[k], from[k] - down), from[k] + up);
    }
    from = out_wz[t - 1];
    wanted = wanted_wz[t - 1];
    to = out_wz[t];
    for (std::size_t k = 0; k < count; ++k) {
      to[k] = std::min(std::max(wanted[k], from[k] - change.turn), from[k] + change.turn);
    }
  }
}

namespace {

/// One number of each sample. No two rows overlap, or loops over so many would not be compiled to vectors.
using Row = float* __restrict;
using ConstRow = const float* __restrict;

MRPBENCH_WIDE void move(std::size_t count, float dt, ConstRow vx, ConstRow wz, ConstRow sine, ConstRow cosine,
                        ConstRow from_x, ConstRow from_y, ConstRow from_yaw, Row x, Row y, Row yaw) {
  for (std::size_t k = 0; k < count; ++k) {
    const float step = vx[k] * dt;
    x[k] = from_x[k] + step * cosine[k];
    y[k] = from_y[k] + step * sine[k];
    yaw[k] = from_yaw[k] + wz[k] * dt;
  }
}

}  // namespace

void roll_out(const Table& vx, const Table& wz, float dt, Table& x, Table& y, Table& yaw) {
  const std::size_t count = vx.samples;
  std::vector<float> sine(count, 0.0f), cosine(count, 1.0f);
  const std::vector<float> start(count, 0.0f);
  for (std::size_t t = 0; t < vx.steps; ++t) {
    if (t > 0) sine_cosine(yaw[t - 1], sine.data(), cosine.data(), count);
    move(count, dt, vx[t], wz[t], sine.data(), cosine.data(), t > 0 ? x[t - 1] : start.data(),
         t > 0 ? y[t - 1] : start.data(), t > 0 ? yaw[t - 1] : start.data(), x[t], y[t], yaw[t]);
  }
}

namespace {

/// The sum of `term(k)`, in eight parts, so that the compiler vectorises it.
template <class Term>
float sum_of(std::size_t count, Term&& term) {
  float sums[8] = {};
  const std::size_t whole = count / 8 * 8;
  for (std::size_t k = 0; k < whole; k += 8) {
    for (std::size_t j = 0; j < 8; ++j) sums[j] += term(k + j);
  }
  for (std::size_t k = whole; k < count; ++k) sums[k - whole] += term(k);
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

}  // namespace

MRPBENCH_WIDE float sum(const float* values, std::size_t count) {
  return sum_of(count, [=](std::size_t k) { return values[k]; });
}

MRPBENCH_WIDE float weighted_sum(const float* weights, const float* values, std::size_t count) {
  return sum_of(count, [=](std::size_t k) { return weights[k] * values[k]; });
}

void smooth(std::span<float> values, const std::array<float, 4>& past, int order) {
  if (values.size() < 21) return;
  static constexpr std::array<float, 9> quadratic{-21, 14, 39, 54, 59, 54, 39, 14, -21};
  std::vector<float> row(past.begin(), past.end());
  row.insert(row.end(), values.begin(), values.end());
  row.insert(row.end(), 4, values.back());
  for (std::size_t t = 0; t + 1 < values.size(); ++t) {
    float sum = 0;
    for (std::size_t j = 0; j < 9; ++j) sum += row[t + j] * (order == 1 ? 1.0f / 9 : quadratic[j] / 231);
    values[t] = sum;
  }
}

void constrain(std::span<float> vx, std::span<float> wz, const Limits& limits, const Accelerations& accelerations,
               double ahead, double turn, double period, double dt) {
  const auto steered = [&](double rate, double speed) {
    if (limits.min_turning_r <= 0) return rate;
    const double most = std::abs(speed) / limits.min_turning_r;
    return std::clamp(rate, -most, most);
  };
  double within = period;
  for (std::size_t t = 0; t < vx.size(); ++t, within = dt) {
    const bool forward = ahead >= 0;
    const double up = (forward ? accelerations.speed_up : accelerations.slow_down) * within;
    const double down = (forward ? accelerations.slow_down : accelerations.speed_up) * within;
    const double change = accelerations.turn * within;
    turn = std::clamp(std::clamp<double>(steered(wz[t], vx[t]), -limits.wz_max, limits.wz_max), turn - change,
                      turn + change);
    ahead = std::clamp(std::clamp<double>(vx[t], limits.vx_min, limits.vx_max), ahead - down, ahead + up);
    turn = steered(turn, ahead);
    vx[t] = static_cast<float>(ahead);
    wz[t] = static_cast<float>(turn);
  }
}

}  // namespace mrpbench::local::mppi
