// Makes a plan without conflicts better, a group of robots at a time. How large the groups are is learned like which
// robots they consist of, as in Phan, Huang, Dilkina and Koenig, "Adaptive anytime multi-agent path finding using
// bandit-based large neighborhood search", AAAI 2024, though by roulette.
#pragma once

#include <optional>

#include "lns/neighbourhood.hpp"
#include "lns/roulette.hpp"
#include "mrpbench_mapf/model/objective.hpp"

namespace mrpbench::mapf::lns {

class Improvement {
 public:
  /// `schedule` holds a plan without conflicts from when `advance` is first called.
  /// `neighbourhood`: robots that are planned anew at a time; nothing: as many as bring most.
  Improvement(Schedule& schedule, Objective objective, std::optional<int> neighbourhood, std::uint64_t seed);

  /// Plan one group anew; keeps what is not worse. True if the plan is better now.
  bool advance();
  /// Bring a copy of the paths that was made before up to date.
  void copy_changed(std::vector<Path>& paths);
  /// Nothing can become better: every robot arrives as early as if it were alone.
  bool is_done() const;

 private:
  static constexpr std::array kSizes{1, 2, 4, 8, 16, 32};
  static constexpr std::size_t kOverhead = 100;  // what planning a robot takes besides expansions, in expansions

  const std::vector<int>& choose(int heuristic, int size);
  Value plan();
  int late_robot();

  Schedule& schedule_;
  Objective objective_;
  Neighbourhood neighbourhood_;
  Random random_;
  std::optional<int> size_;
  Roulette<3> heuristics_;
  Roulette<kSizes.size()> sizes_;
  std::vector<int> robots_;
  std::vector<int> changed_;  // perhaps repeatedly
  std::vector<bool> tried_;   // late robots, until all were
};

}  // namespace mrpbench::mapf::lns
