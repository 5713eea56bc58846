#include "mrpbench_local/critic.hpp"

#include "mrpbench_local/critics.hpp"

namespace mrpbench::local {

std::unique_ptr<Critic> make_critic(std::string_view name, std::map<std::string, double> values) {
  static const std::map<std::string_view, std::unique_ptr<Critic> (*)(CriticOptions&)> kinds{
      {"RotateToGoal", rotate_to_goal},  {"Oscillation", oscillation},
      {"BaseObstacle", base_obstacle},   {"ObstacleFootprint", obstacle_footprint},
      {"PathDist", path_dist},           {"GoalDist", goal_dist},
      {"PathAlign", path_align},         {"GoalAlign", goal_align},
      {"PreferForward", prefer_forward}, {"Twirling", twirling},
  };
  const auto kind = kinds.find(name);
  if (kind == kinds.end()) throw std::invalid_argument("there is no critic " + std::string(name));
  CriticOptions options(std::move(values));
  auto critic = kind->second(options);
  options.finish();
  return critic;
}

Aggregation aggregation(CriticOptions& options, Aggregation otherwise) {
  return static_cast<Aggregation>(static_cast<int>(options.take("aggregation", static_cast<double>(otherwise))));
}

}  // namespace mrpbench::local
