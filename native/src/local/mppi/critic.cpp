#include "mrpbench_local/mppi/critic.hpp"

#include <map>
#include <stdexcept>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local::mppi {

MRPBENCH_WIDE void WeightedCritic::add(std::span<const float> raw, std::span<float> total) const {
  if (power == 1) {
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < raw.size(); ++k) total[k] += weight * raw[k];
    return;
  }
  for (std::size_t k = 0; k < raw.size(); ++k) {
    const float weighted = weight * raw[k];
    float product = weighted;
    for (int i = 1; i < power; ++i) product *= weighted;
    total[k] += product;
  }
}

const CriticKind& critic_kind(const std::string& name) {
  static const std::map<std::string, CriticKind> kinds{
      {"ConstraintCritic", constraint_critic()},
      {"CostCritic", cost_critic()},
      {"GoalCritic", goal_critic()},
      {"GoalAngleCritic", goal_angle_critic()},
      {"ObstaclesCritic", obstacles_critic()},
      {"PathAlignCritic", path_align_critic()},
      {"PathAngleCritic", path_angle_critic()},
      {"PathFollowCritic", path_follow_critic()},
      {"PredictedObstacleCritic", predicted_obstacle_critic()},
      {"PreferForwardCritic", prefer_forward_critic()},
      {"TwirlingCritic", twirling_critic()},
      {"VelocityDeadbandCritic", velocity_deadband_critic()},
  };
  const auto kind = kinds.find(name);
  if (kind == kinds.end()) throw std::invalid_argument("there is no critic " + name);
  return kind->second;
}

}  // namespace mrpbench::local::mppi
