// Costs of moves from the traffic of an execution.
#pragma once

#include <vector>

#include "mrpbench_discrete/distance_tables.hpp"

namespace mrpbench::discrete {

/// Makes moves cost more that meet opposite traffic or lead to cells in which robots stay, so that ways separate by
/// direction and keep away from crowds. The costs are those of Chen, Harabor, Li and Stuckey, "Traffic Flow
/// Optimisation for Lifelong Multi-Agent Path Finding" (AAAI 2024), but of the traffic that was observed, not planned.
class Guidance {
 public:
  /// Sets costs of `tables`, which must be empty.
  Guidance(const Grid& grid, DistanceTables& tables);

  /// See a step from these poses.
  void observe(const std::vector<Pose>& pose, const std::vector<Action>& action);
  /// Take some time to bring costs and tables up to date. Call it once a step, where no table is held.
  void update();

 private:
  Costs costs() const;

  const Grid& grid_;
  DistanceTables& tables_;
  /// Moves from each pose and stays in each cell in a step: means of which former steps fade.
  std::vector<float> moves_, stays_;
  float steps_ = 0;
  int age_ = 0;
};

}  // namespace mrpbench::discrete
