#include "mrpbench_local/robot_options.hpp"

namespace mrpbench::local {

Description<CostmapOptions> CostmapOptions::grid() {
  using C = CostmapOptions;
  return {{"width", &C::width, above(0, "m"), "side of the costmap, which is centred on the robot"},
          {"height", &C::height, above(0, "m"), "side of the costmap, which is centred on the robot"},
          {"resolution", &C::resolution, above(0, "m"), "side of a cell"},
          {"update_frequency", &C::update_frequency, above(0, "Hz"), "update rate of the costmap"},
          {"footprint_padding", &C::footprint_padding, at_least(0, "m"), "room around the footprint"},
          {"footprint_clearing_enabled", &C::footprint_clearing, "clear the cells under the robot"}};
}

Description<CostmapOptions> CostmapOptions::inflation() {
  using C = CostmapOptions;
  return {
      {"inflation_radius", &C::inflation_radius, at_least(0, "m"), "distance up to which obstacles cost something"},
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

Description<MotionOptions> MotionOptions::description() {
  using M = MotionOptions;
  return {
      {"min_vel_x", &M::min_vel_x, any("m/s"), "lowest speed; negative = may drive back"},
      {"max_vel_x", &M::max_vel_x, above(0, "m/s"), "highest speed; by default the robot's"},
      {"max_vel_theta", &M::max_vel_theta, above(0, "rad/s"), "highest turn rate, within the robot's limit"},
      {"min_speed_xy", &M::min_speed_xy, any("m/s"),
       "samples with a lower speed must turn faster than min_speed_theta"},
      {"max_speed_xy", &M::max_speed_xy, any("m/s"), "highest speed in the plane; by default max_vel_x"},
      {"min_speed_theta", &M::min_speed_theta, any("rad/s"),
       "samples that turn slower than this must drive faster than min_speed_xy"},
      {"acc_lim_x", &M::acc_lim_x, above(0), "acceleration, m/s^2; by default the robot's"},
      {"acc_lim_theta", &M::acc_lim_theta, above(0), "acceleration, rad/s^2; by default the robot's"},
      {"decel_lim_x", &M::decel_lim_x, "deceleration, negative; by default the robot's"},
      {"decel_lim_theta", &M::decel_lim_theta, "deceleration, negative; by default the robot's"},
      {"vx_samples", &M::vx_samples, within(1, 1000), "number of speeds that are sampled"},
      {"vtheta_samples", &M::vtheta_samples, within(1, 1000), "number of turn rates that are sampled"},
      {"sim_time", &M::sim_time, above(0, "s"), "duration of a trajectory"},
      {"linear_granularity", &M::linear_granularity, above(0, "m"), "longest step of a trajectory"},
      {"angular_granularity", &M::angular_granularity, above(0), "largest turn in a step of a trajectory, radians"},
      {"discretize_by_time", &M::discretize_by_time, "step by time_granularity instead of by way and angle"},
      {"time_granularity", &M::time_granularity, above(0, "s"), "longest step of a trajectory"},
      {"include_last_point", &M::include_last_point, "count the last pose twice where scores are summed"},
      {"trajectory_generator_name", &M::limited,
       Choices<bool>{{"dwb_plugins::StandardTrajectoryGenerator", false}, {"dwb_plugins::LimitedAccelGenerator", true}},
       "accelerate to sampled velocities along the trajectory, or sample only what one period can reach"}};
}

Description<DwbOptions> DwbOptions::nav2() {
  Description<DwbOptions> rows;
  append(rows, MotionOptions::description(), &DwbOptions::motion);
  append(rows,
         Description<Pruning>{{"prune_distance", &Pruning::prune_distance, above(0, "m"),
                               "ignore parts of the path that are farther away"},
                              {"shorten_transformed_plan", &Pruning::shorten,
                               "use prune_distance; if false, half the size of the costmap"}},
         &DwbOptions::pruning);
  rows.push_back({"short_circuit_trajectory_evaluation", &DwbOptions::short_circuit,
                  "stop scoring a trajectory that cannot win; false = score all in full, for `explain`"});
  return rows;
}

Description<DwbOptions> DwbOptions::further() {
  return {
      {{"beyond_end", &Pruning::beyond_end, at_least(0, "m"),
        "prolong the path straight beyond its end by this, for critics that measure distances to it, so that a robot "
        "comes nearer to the end than the 0.25 m of Nav2; 0 = as in Nav2"},
       &DwbOptions::pruning},
      {"rotate_to_path", &DwbOptions::rotate_to_path, at_least(0),
       "turn on the spot first where a new path leads off the heading by more than this, radians, as the rotation "
       "shim of Nav2 does; 0 = never, as DWB alone"}};
}

Description<RobotOptions> RobotOptions::further() {
  Description<RobotOptions> rows;
  append(rows, DwbOptions::further(), &RobotOptions::dwb);
  rows.push_back(
      {"max_detour", &RobotOptions::max_detour, at_least(0, "m"), "largest distance of a detour from a blocked path"});
  return rows;
}

Description<RobotOptions> RobotOptions::description() {
  Description<RobotOptions> rows = further();
  append(rows, DwbOptions::nav2(), &RobotOptions::dwb);
  for (const auto& group :
       {CostmapOptions::grid(), CostmapOptions::inflation(), CostmapOptions::observation(), CostmapOptions::layers()}) {
    append(rows, group, &RobotOptions::costmap);
  }
  const Option<MotionOptions> period{"period", &MotionOptions::period, above(0, "s"), "control period"};
  rows.push_back({Option<DwbOptions>(period, &DwbOptions::motion), &RobotOptions::dwb});
  const Option<Point> forward{"lidar_forward", &Point::x, any("m"), "place of the lidar ahead of the robot's origin"};
  const Option<Point> leftward{"lidar_leftward", &Point::y, any("m"), "place of the lidar left of the robot's origin"};
  rows.push_back({Option<Sensor>(forward, &Sensor::mount), &RobotOptions::sensor});
  rows.push_back({Option<Sensor>(leftward, &Sensor::mount), &RobotOptions::sensor});
  rows.push_back({{"lidar_range", &Sensor::range, at_least(0, "m"), "range of the lidar"}, &RobotOptions::sensor});
  rows.push_back({"by_radius", &RobotOptions::by_radius, "the robot is a disc of robot_radius"});
  rows.push_back({"robot_radius", &RobotOptions::robot_radius, at_least(0, "m"), "radius of that disc"});
  return rows;
}

std::vector<Parameter> robot_parameters(const std::string& group) {
  if (group == "dwb") return parameters(DwbOptions::nav2());
  if (group == "dwb_further") return parameters(RobotOptions::further());
  if (group == "costmap_grid") return parameters(CostmapOptions::grid());
  if (group == "inflation") return parameters(CostmapOptions::inflation());
  if (group == "observation") return parameters(CostmapOptions::observation());
  throw std::invalid_argument("there is no group of options '" + group + "'");
}

}  // namespace mrpbench::local
