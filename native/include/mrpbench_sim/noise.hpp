// Random numbers that are functions of seed, robot and period, so that nothing else in a run changes them.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace mrpbench::sim {

/// The draws of one robot in one control period. Mixing: G. L. Steele, D. Lea, C. H. Flood, "Fast splittable
/// pseudorandom number generators", OOPSLA 2014.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t robot, std::uint64_t period)
      : state_(mix(mix(mix(seed) + kStep * (robot + 1)) + kStep * (period + 1))) {}

  /// Independent bits, each 0 or 1 with equal probability.
  std::uint64_t bits() { return mix(state_ += kStep); }

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Two independent standard normal numbers (G. E. P. Box and M. E. Muller, Ann. Math. Statist. 29, 1958).
  std::pair<double, double> normal() {
    const double size = std::sqrt(-2 * std::log(1 - uniform())), angle = 2 * std::numbers::pi * uniform();
    return {size * std::cos(angle), size * std::sin(angle)};
  }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15u;

  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace mrpbench::sim
