// Everything that the local controller of one robot needs to know.
#pragma once

#include "mrpbench_local/dwb.hpp"

namespace mrpbench::local {

struct RobotOptions {
  CostmapOptions costmap;
  DwbOptions dwb;
  Sensor sensor;
  /// Check collisions at the centre instead of along the outline, of a disc of this radius.
  bool by_radius = true;
  double robot_radius = 0;
  double max_detour = 0.5;

  /// Options that Nav2 does not have.
  static Description<RobotOptions> further();
  /// All options, including those that follow from the robot and the control period.
  static Description<RobotOptions> description();
};

/// The options of the groups "dwb", "dwb_further", "costmap_grid", "inflation" and "observation".
/// Throws std::invalid_argument if there is no such group.
std::vector<Parameter> robot_parameters(const std::string& group);

}  // namespace mrpbench::local
