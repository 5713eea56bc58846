#include "mrpbench_local/mppi/noise.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace mrpbench::local::mppi {

namespace {

/// The quantiles in units, rounded: the first numbers whose upper ends have at least their probability below them.
std::vector<std::int16_t> quantiles() {
  constexpr int kPer = Noise::kPer, kMost = Noise::kMost;
  constexpr int count = 1 << 16;
  const auto below = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
  std::vector<std::int16_t> found;
  int units = -kMost * kPer;
  for (int i = 0; i < count; ++i) {
    while (below((units + 0.5) * Noise::kUnit) < (i + 0.5) / count) ++units;
    found.push_back(static_cast<std::int16_t>(units));
  }
  return found;
}

}  // namespace

void Noise::draw(sim::Draws& draws) {
  static const std::vector<std::int16_t> quantile = quantiles();
  for (Rows<std::int16_t>* const it : {&vx, &wz}) {
    for (std::size_t t = 0; t < it->steps; ++t) {
      std::int16_t* const row = (*it)[t];
      std::uint64_t bits = 0;
      for (std::size_t k = 0; k < it->samples; ++k, bits >>= 16) {
        if (k % 4 == 0) bits = draws.bits();
        row[k] = quantile[bits & 0xFFFF];
      }
    }
  }
}

}  // namespace mrpbench::local::mppi
