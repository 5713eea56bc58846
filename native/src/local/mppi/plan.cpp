#include "mrpbench_local/mppi/plan.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local::mppi {

namespace {

/// Numbers of neighbouring samples. Sums have as many parts, which are added up in the end.
constexpr std::size_t kBlock = 8;
using Block = float __attribute__((vector_size(kBlock * sizeof(float))));

void load(Block& block, const float* from) {
  std::memcpy(&block, from, sizeof block);
}

void load(Block& block, Controls from, std::size_t k) {
  load(block, from.row + k);
  block += from.base;
}

float total(const Block& it) {
  return ((it[0] + it[1]) + (it[2] + it[3])) + ((it[4] + it[5]) + (it[6] + it[7]));
}

}  // namespace

MRPBENCH_WIDE float sum(const float* values, std::size_t count) {
  Block sum{};
  std::size_t k = 0;
  for (; k + kBlock <= count; k += kBlock) {
    Block value;
    load(value, values + k);
    sum += value;
  }
  for (; k < count; ++k) sum[k % kBlock] += values[k];
  return total(sum);
}

MRPBENCH_WIDE std::pair<float, float> weighted_sums(const float* weights, Controls vx, Controls wz, std::size_t count) {
  Block sum_vx{}, sum_wz{};
  std::size_t k = 0;
  for (; k + kBlock <= count; k += kBlock) {
    Block weight, speed, rate;
    load(weight, weights + k);
    load(speed, vx, k);
    load(rate, wz, k);
    sum_vx += weight * speed;
    sum_wz += weight * rate;
  }
  for (; k < count; ++k) {
    sum_vx[k % kBlock] += weights[k] * vx[k];
    sum_wz[k % kBlock] += weights[k] * wz[k];
  }
  return {total(sum_vx), total(sum_wz)};
}

float weighted_sum(const float* weights, const float* values, std::size_t count) {
  return weighted_sums(weights, {0, values}, {0, values}, count).first;
}

MRPBENCH_WIDE void add_deviation(Controls vx, Controls wz, float plan_vx, float plan_wz, float per_vx, float per_wz,
                                 std::span<float> total) {
  MRPBENCH_NO_OVERLAP
  for (std::size_t k = 0; k < total.size(); ++k) {
    total[k] += per_vx * (vx[k] - plan_vx) + per_wz * (wz[k] - plan_wz);
  }
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
