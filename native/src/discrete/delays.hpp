// Delays by chance (2026), the same for every planner: draws are functions of seed, tick and robot.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mrpbench_discrete/problem.hpp"

namespace mrpbench::discrete {

class DelayModel {
 public:
  DelayModel(const Delays& options, std::size_t robots);
  /// Before the motion of a tick: who is delayed in it.
  const std::vector<std::uint8_t>& tick(int time);
  /// For each robot: the ticks [start, end) of its delays.
  const std::vector<std::vector<std::array<std::int32_t, 2>>>& intervals() const { return intervals_; }

 private:
  void hit(int time, std::size_t robot);

  const Delays options_;
  std::vector<std::int32_t> remaining_, available_;
  std::vector<std::uint8_t> delayed_;
  std::vector<std::vector<std::array<std::int32_t, 2>>> intervals_;
};

}  // namespace mrpbench::discrete
