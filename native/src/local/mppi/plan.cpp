#include "mrpbench_local/mppi/plan.hpp"

#include <algorithm>
#include <vector>

#include "mrpbench_local/wide.hpp"

namespace mrpbench::local::mppi {

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
