// Chooses between heuristics by their recent improvements: Ropke and Pisinger, "An adaptive large neighborhood search
// heuristic for the pickup and delivery problem with time windows", Transportation Science 2006.
#pragma once

#include <algorithm>
#include <array>

#include "mrpbench_mapf/common/random.hpp"

namespace mrpbench::mapf::lns {

template <int count>
class Roulette {
 public:
  int spin(Random& random) {
    double sum = 0;
    for (const double weight : weight_) sum += weight;
    double at = random.unit() * sum;
    for (int i = 0; i + 1 < count; ++i) {
      if ((at -= weight_[i]) < 0) return i;
    }
    return count - 1;
  }
  void reward(int choice, double gain) {
    double& weight = weight_[choice];
    weight = std::max(kLeast, (1 - kReaction) * weight + kReaction * gain);
  }

 private:
  static constexpr double kReaction = 0.01;
  static constexpr double kLeast = 1e-5;  // nothing is ruled out for good
  std::array<double, count> weight_ = [] {
    std::array<double, count> ones;
    ones.fill(1.0);
    return ones;
  }();
};

}  // namespace mrpbench::mapf::lns
