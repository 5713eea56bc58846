// Normal noise of the controls that MPPI samples.
#pragma once

#include <cstdint>

#include "mrpbench_local/mppi/batch.hpp"
#include "mrpbench_sim/noise.hpp"

namespace mrpbench::local::mppi {

/// Noise of all steps of a block of samples. Step t takes the row t + `first`, in a circle. Numbers count `kUnit`
/// standard deviations: that of a fleet is read from memory in each period, and has half the size of floats.
struct Noise {
  static constexpr int kPer = 4096, kMost = 5;  // units in a standard deviation, and more of these than there are
  static constexpr float kUnit = 1.0f / kPer;

  Rows<std::int16_t> vx, wz;
  std::size_t first = 0;

  std::size_t row(std::size_t t) const { return t + first < vx.steps ? t + first : t + first - vx.steps; }
  /// Fill the rows with independent numbers: quantiles of the standard normal distribution at (i + 1/2) / 2^16, where
  /// all i are equally probable.
  void draw(sim::Draws& draws);
};

}  // namespace mrpbench::local::mppi
