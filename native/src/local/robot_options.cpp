#include "mrpbench_local/robot_options.hpp"

namespace mrpbench::local {

Description<CostmapOptions> CostmapOptions::grid() {
  using C = CostmapOptions;
  return {{"width", &C::width, within(0.1, 1000, "m"), "side of the costmap, which is centred on the robot"},
          {"height", &C::height, within(0.1, 1000, "m"), "side of the costmap, which is centred on the robot"},
          {"resolution", &C::resolution, within(0.001, 10, "m"), "side of a cell"},
          {"update_frequency", &C::update_frequency, above(0, "Hz"), "update rate of the costmap"},
          {"footprint_padding", &C::footprint_padding, within(0, 10, "m"), "room around the footprint"},
          {"footprint_clearing_enabled", &C::footprint_clearing, "clear the cells under the robot"}};
}

Description<CostmapOptions> CostmapOptions::inflation() {
  using C = CostmapOptions;
  return {
      {"inflation_radius", &C::inflation_radius, within(0, 100, "m"), "distance up to which obstacles cost something"},
      {"cost_scaling_factor", &C::cost_scaling_factor, at_least(0), "rate at which costs decrease with distance, 1/m"}};
}

Description<CostmapOptions> CostmapOptions::observation() {
  using C = CostmapOptions;
  return {{"obstacle_max_range", &C::obstacle_max_range, at_least(0, "m"), "returns beyond this mark nothing"},
          {"obstacle_min_range", &C::obstacle_min_range, at_least(0, "m"), "returns nearer than this mark nothing"},
          {"raytrace_max_range", &C::raytrace_max_range, at_least(0, "m"), "beams clear cells up to this range"},
          {"raytrace_min_range", &C::raytrace_min_range, at_least(0, "m"), "beams clear cells from this range on"},
          {"marking", &C::marking, "scans mark obstacles"},
          {"clearing", &C::clearing, "scans clear the cells that beams pass"},
          {"inf_is_valid", &C::inf_is_valid, "beams without a return clear cells too"}};
}

Description<CostmapOptions> CostmapOptions::layers() {
  using C = CostmapOptions;
  return {{"obstacle_layer", &C::obstacle_layer, "scans mark and clear cells"},
          {"static_layer", &C::static_layer, "the walls of the map are obstacles"},
          {"inflation_layer", &C::inflation_layer, "costs decrease around obstacles"}};
}

Description<RobotOptions> RobotOptions::further() {
  return {
      {"max_detour", &RobotOptions::max_detour, at_least(0, "m"), "largest distance of a detour from a blocked path"}};
}

Description<RobotOptions> RobotOptions::description() {
  Description<RobotOptions> rows = further();
  for (const auto& group :
       {CostmapOptions::grid(), CostmapOptions::inflation(), CostmapOptions::observation(), CostmapOptions::layers()}) {
    append(rows, group, &RobotOptions::costmap);
  }
  const Option<Point> forward{"lidar_forward", &Point::x, any("m"), "place of the lidar ahead of the robot's origin"};
  const Option<Point> leftward{"lidar_leftward", &Point::y, any("m"), "place of the lidar left of the robot's origin"};
  rows.push_back({Option<Sensor>(forward, &Sensor::mount), &RobotOptions::sensor});
  rows.push_back({Option<Sensor>(leftward, &Sensor::mount), &RobotOptions::sensor});
  rows.push_back({{"lidar_range", &Sensor::range, at_least(0, "m"), "range of the lidar"}, &RobotOptions::sensor});
  rows.push_back({"by_radius", &RobotOptions::by_radius, "the robot is a disc of robot_radius"});
  rows.push_back({"robot_radius", &RobotOptions::robot_radius, within(0, 10, "m"), "radius of that disc"});
  return rows;
}

std::vector<Parameter> robot_parameters(const std::string& group) {
  if (group == "costmap_grid") return parameters(CostmapOptions::grid());
  if (group == "inflation") return parameters(CostmapOptions::inflation());
  if (group == "observation") return parameters(CostmapOptions::observation());
  if (group == "further") return parameters(RobotOptions::further());
  throw std::invalid_argument("there is no group of options '" + group + "'");
}

}  // namespace mrpbench::local
