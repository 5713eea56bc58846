// What all local controllers need to know of a robot: its costmap, lidar and shape.
#pragma once

#include "mrpbench_local/costmap/costmap.hpp"

namespace mrpbench::local {

struct RobotOptions {
  CostmapOptions costmap;
  Sensor sensor;
  /// Check collisions at the centre instead of along the outline, of a disc of this radius.
  bool by_radius = true;
  double robot_radius = 0;
  double max_detour = 0.5;

  /// Options that Nav2 does not have.
  static Description<RobotOptions> further();
  /// All options, including those that follow from the robot.
  static Description<RobotOptions> description();
};

/// The options of the groups "costmap_grid", "inflation", "observation" and "further".
/// Throws std::invalid_argument if there is no such group.
std::vector<Parameter> robot_parameters(const std::string& group);

}  // namespace mrpbench::local
