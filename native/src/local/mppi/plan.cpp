#include "mrpbench_local/mppi/plan.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local::mppi {

namespace {

/// Numbers of neighbouring samples. Sums have as many parts, which are added up in the end.
constexpr std::size_t kLanes = 16;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));

void load(Lanes& lanes, const float* from) {
  std::memcpy(&lanes, from, sizeof lanes);
}

void load(Lanes& lanes, const std::int16_t* from) {
  std::int16_t __attribute__((vector_size(kLanes * sizeof(std::int16_t)))) row;
  std::memcpy(&row, from, sizeof row);
  using Numbers = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));
  lanes = __builtin_convertvector(__builtin_convertvector(row, Numbers), Lanes);
}

float total(const Lanes& it) {
  float part[8];
  for (std::size_t i = 0; i < 8; ++i) part[i] = it[i] + it[i + 8];
  return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

template <class T>
[[gnu::always_inline]] inline void add_weighted_of(std::span<const float> weights, std::span<const Deviations<T>> steps,
                                                   std::span<float> plan) {
  for (std::size_t t = 0; t < steps.size(); ++t) {
    const Deviations<T> from = steps[t];
    Lanes sums[2]{};
    for (std::size_t k = 0; k < weights.size(); k += 2 * kLanes) {
      for (std::size_t i = 0; i < 2; ++i) {
        Lanes weight, value;
        load(weight, &weights[k + i * kLanes]);
        load(value, from.row + k + i * kLanes);
        sums[i] += weight * (value * from.unit - from.plan);
      }
    }
    plan[t] += total(sums[0] + sums[1]);
  }
}

template <class T>
[[gnu::always_inline]] inline void add_deviations_of(std::span<const Deviations<T>> steps, std::span<const float> per,
                                                     std::span<float> total) {
  float* const sums = total.data();
  const std::size_t count = total.size();
  for (std::size_t t = 0; t < steps.size(); ++t) {
    const T* const row = steps[t].row;
    const float unit = steps[t].unit, plan = steps[t].plan, cost = per[t];
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < count; ++k) sums[k] += cost * (static_cast<float>(row[k]) * unit - plan);
  }
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
  add_weighted_of(weights, steps, plan);
}

MRPBENCH_WIDE void add_weighted(std::span<const float> weights, VelocityRows steps, std::span<float> plan) {
  add_weighted_of(weights, steps, plan);
}

MRPBENCH_WIDE void add_deviations(NoiseRows steps, std::span<const float> per, std::span<float> total) {
  add_deviations_of(steps, per, total);
}

MRPBENCH_WIDE void add_deviations(VelocityRows steps, std::span<const float> per, std::span<float> total) {
  add_deviations_of(steps, per, total);
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
