#include "mrpbench_local/dwb/critic.hpp"

#include <map>
#include <string>

#include "mrpbench_local/dwb/critics.hpp"

namespace mrpbench::local {

const CriticKind& critic_kind(std::string_view name) {
  static const std::map<std::string_view, CriticKind> kinds{
      {"RotateToGoal", rotate_to_goal()},
      {"Oscillation", oscillation()},
      {"BaseObstacle", base_obstacle()},
      {"ObstacleFootprint", obstacle_footprint()},
      {"PathDist", path_dist()},
      {"GoalDist", goal_dist()},
      {"PathAlign", path_align()},
      {"GoalAlign", goal_align()},
      {"PreferForward", prefer_forward()},
      {"Twirling", twirling()},
      {"PredictedObstacle", predicted_obstacle()},
  };
  const auto kind = kinds.find(name);
  if (kind == kinds.end()) throw std::invalid_argument("there is no critic " + std::string(name));
  return kind->second;
}

std::unique_ptr<Critic> make_critic(std::string_view name, const OptionValues& options) {
  try {
    return critic_kind(name).make(options);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string(name) + ": " + error.what());
  }
}

}  // namespace mrpbench::local
