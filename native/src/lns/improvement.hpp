// Makes a plan without conflicts better, a group of robots at a time.
#pragma once

#include "lns/neighbourhood.hpp"
#include "lns/roulette.hpp"
#include "mrpbench_mapf/objective.hpp"

namespace mrpbench::mapf::lns {

class Improvement {
 public:
  /// `schedule` holds a plan without conflicts from when `advance` is first called.
  Improvement(Schedule& schedule, Objective objective, int neighbourhood, std::uint64_t seed);

  /// Plan one group anew; keeps what is not worse. True if the plan is better now.
  bool advance();
  /// Nothing can become better: every robot arrives as early as if it were alone.
  bool is_done() const;

 private:
  const std::vector<int>& choose(int heuristic);
  int late_robot();

  Schedule& schedule_;
  Objective objective_;
  Neighbourhood neighbourhood_;
  Random random_;
  Roulette<3> roulette_;
  std::vector<int> robots_;
  std::vector<bool> tried_;  // late robots, until all were
};

}  // namespace mrpbench::mapf::lns
