#include "mrpbench_local/mppi/plan.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "mrpbench_common/wide.hpp"
#include "mrpbench_local/mppi/noise.hpp"

namespace mrpbench::local::mppi {

namespace {

/// Numbers of neighbouring samples. Sums have as many parts, which are added up in the end.
constexpr std::size_t kLanes = 16;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));

void load(Lanes& lanes, const float* from) {
  std::memcpy(&lanes, from, sizeof lanes);
}

float total(const Lanes& it) {
  float part[8];
  for (std::size_t i = 0; i < 8; ++i) part[i] = it[i] + it[i + 8];
  return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

}  // namespace

MRPBENCH_WIDE float sum(std::span<const float> weights) {
  Lanes sum{};
  for (std::size_t k = 0; k < weights.size(); k += kLanes) {
    Lanes weight;
    load(weight, &weights[k]);
    sum += weight;
  }
  return total(sum);
}

MRPBENCH_WIDE void add_weighted(std::span<const float> weights, NoiseRows steps, std::span<float> plan) {
  constexpr std::int32_t kWhole = std::numeric_limits<std::int16_t>::max();
  static_assert((kWhole + kBlock) * Noise::kMost * Noise::kPer <= std::numeric_limits<std::int32_t>::max());
  const float whole = sum(weights);
  if (whole == 0) return;
  const std::size_t count = weights.size();
  std::array<std::int16_t, kBlock> part;
  for (std::size_t k = 0; k < count; ++k) part[k] = static_cast<std::int16_t>(weights[k] / whole * kWhole + 0.5f);
  for (std::size_t t = 0; t < steps.size(); ++t) {
    std::int32_t sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += part[k] * steps[t].row[k];
    plan[t] += static_cast<float>(sum) * (steps[t].unit * whole / kWhole);
  }
}

MRPBENCH_WIDE void add_weighted(std::span<const float> weights, VelocityRows steps, std::span<float> plan) {
  for (std::size_t t = 0; t < steps.size(); ++t) {
    Lanes sum{};
    for (std::size_t k = 0; k < weights.size(); k += kLanes) {
      Lanes weight, velocity;
      load(weight, &weights[k]);
      load(velocity, steps[t].row + k);
      sum += weight * (velocity - steps[t].plan);
    }
    plan[t] += total(sum);
  }
}

MRPBENCH_WIDE void add_deviations(NoiseRows steps, std::span<const float> per, std::span<float> total) {
  for (std::size_t t = 0; t < steps.size(); ++t) {
    const std::int16_t* const row = steps[t].row;
    const float cost = per[t] * steps[t].unit;
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < total.size(); ++k) total[k] += cost * static_cast<float>(row[k]);
  }
}

MRPBENCH_WIDE void add_deviations(VelocityRows steps, std::span<const float> per, std::span<float> total) {
  for (std::size_t t = 0; t < steps.size(); ++t) {
    const float* const row = steps[t].row;
    const float cost = per[t], plan = steps[t].plan;
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < total.size(); ++k) total[k] += cost * (row[k] - plan);
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
