// Python bindings of local navigation: arrays in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <stdexcept>

#include "arrays.hpp"
#include "mrpbench_local/fleet.hpp"
#include "mrpbench_local/footprint.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::local;

namespace {

using Output = nb::ndarray<nb::numpy, double>;
using Settings = std::map<std::string, double>;
using Critics = std::vector<std::tuple<std::string, double, Settings>>;

static_assert(sizeof(Segment) == 4 * sizeof(double) && sizeof(Pose) == 3 * sizeof(double));
static_assert(sizeof(Twist) == 2 * sizeof(double) && sizeof(Point) == 2 * sizeof(double));

Output points_array(const std::vector<Point>& points) {
  std::vector<double> values;
  for (const Point& p : points) values.insert(values.end(), {p.x, p.y});
  return own(std::move(values), {points.size(), 2});
}

std::optional<Output> way_array(const std::optional<std::vector<Point>>& way) {
  if (!way) return std::nullopt;
  return points_array(*way);
}

Path whole(const Matrix<2>& path) {
  require(path.shape(0) > 0, "a path has a beginning");
  const auto all = rows<Point>(path);
  return {all[0], all.subspan(1)};
}

RobotOptions robot_options(const Settings& settings, const Matrix<2>& footprint) {
  CriticOptions given(settings);
  RobotOptions all;
  const auto take = [&](const char* name, double& value) { value = given.take(name, value); };
  const auto flag = [&](const char* name, bool& value) { value = given.take(name, value) != 0; };
  const auto whole = [&](const char* name, int& value) { value = static_cast<int>(given.take(name, value)); };
  CostmapOptions& map = all.costmap;
  take("width", map.width), take("height", map.height), take("resolution", map.resolution);
  take("update_frequency", map.update_frequency);
  flag("obstacle_layer", map.obstacle_layer), flag("static_layer", map.static_layer);
  flag("inflation_layer", map.inflation_layer), flag("marking", map.marking), flag("clearing", map.clearing);
  flag("inf_is_valid", map.inf_is_valid), flag("footprint_clearing_enabled", map.footprint_clearing);
  take("obstacle_max_range", map.obstacle_max_range), take("obstacle_min_range", map.obstacle_min_range);
  take("raytrace_max_range", map.raytrace_max_range), take("raytrace_min_range", map.raytrace_min_range);
  take("inflation_radius", map.inflation_radius), take("cost_scaling_factor", map.cost_scaling_factor);
  MotionOptions& motion = all.dwb.motion;
  take("min_vel_x", motion.min_vel_x), take("max_vel_x", motion.max_vel_x);
  take("max_vel_theta", motion.max_vel_theta), take("min_speed_xy", motion.min_speed_xy);
  take("max_speed_xy", motion.max_speed_xy), take("min_speed_theta", motion.min_speed_theta);
  take("acc_lim_x", motion.acc_lim_x), take("decel_lim_x", motion.decel_lim_x);
  take("acc_lim_theta", motion.acc_lim_theta), take("decel_lim_theta", motion.decel_lim_theta);
  whole("vx_samples", motion.vx_samples), whole("vtheta_samples", motion.vtheta_samples);
  take("sim_time", motion.sim_time), take("linear_granularity", motion.linear_granularity);
  take("angular_granularity", motion.angular_granularity), take("time_granularity", motion.time_granularity);
  flag("discretize_by_time", motion.discretize_by_time), flag("include_last_point", motion.include_last_point);
  flag("limited", motion.limited), take("period", motion.period);
  take("prune_distance", all.dwb.pruning.prune_distance);
  flag("shorten_transformed_plan", all.dwb.pruning.shorten);
  take("beyond_end", all.dwb.pruning.beyond_end);
  take("rotate_to_path", all.dwb.rotate_to_path);
  take("min_x_velocity_threshold", all.dwb.min_x_velocity_threshold);
  take("min_theta_velocity_threshold", all.dwb.min_theta_velocity_threshold);
  flag("short_circuit_trajectory_evaluation", all.dwb.short_circuit);
  take("lidar_forward", all.sensor.mount.x), take("lidar_leftward", all.sensor.mount.y);
  take("lidar_range", all.sensor.range);
  flag("by_radius", all.by_radius), take("max_detour", all.max_detour);
  const double padding = given.take("footprint_padding", 0.01);
  const double radius = given.take("robot_radius", 0);
  given.finish();
  map.footprint = padded(all.by_radius ? rounded(radius) : copy<Point>(footprint), padding);
  return all;
}

void add(Fleet& self, const Settings& settings, const Matrix<2>& footprint, const Critics& critics) {
  std::vector<Dwb::Weighted> weighted;
  for (const auto& [name, scale, options] : critics) weighted.push_back({name, scale, make_critic(name, options)});
  self.add(robot_options(settings, footprint), std::move(weighted));
}

void see(Fleet& self, double now, const Vector<std::int32_t>& robots, const Matrix<3>& poses,
         const nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>& ranges) {
  require(ranges.shape(0) == robots.size() && poses.shape(0) == self.size(), "a scan for each robot, a pose for all");
  for (const std::int32_t robot : rows<std::int32_t>(robots)) {
    require(robot >= 0 && static_cast<std::size_t>(robot) < self.size(), "there is no such robot");
  }
  const nb::gil_scoped_release release;
  self.see(now, rows<std::int32_t>(robots), rows<Pose>(poses), {ranges.data(), ranges.size()});
}

/// One trajectory after the other, each padded with its last pose: f8[m,p,3].
Output poses_array(const Trajectories& all) {
  std::vector<std::vector<Pose>> walked(all.size());
  std::size_t longest = 1;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all.walk(i, [&](Pose pose) {
      walked[i].push_back(pose);
      return true;
    });
    longest = std::max(longest, walked[i].size());
  }
  std::vector<double> values;
  values.reserve(all.size() * longest * 3);
  for (auto& poses : walked) {
    poses.resize(longest, poses.back());
    for (const Pose& it : poses) values.insert(values.end(), {it.x, it.y, it.yaw});
  }
  return own(std::move(values), {all.size(), longest, 3});
}

Output twists_array(const Trajectories& all) {
  std::vector<double> values;
  for (std::size_t i = 0; i < all.size(); ++i) values.insert(values.end(), {all.twist(i).ahead, all.twist(i).turn});
  return own(std::move(values), {all.size(), 2});
}

Output command(Fleet& self, double now, const Vector<std::int64_t>& robot, const Matrix<3>& pose,
               const Matrix<2>& twist, const Matrix<2>& foot, const Matrix<2>& points,
               const Vector<std::int64_t>& begin, const Vector<std::int64_t>& end, const Vector<double>& yaw,
               const Vector<double>& speed, double tolerance, const nb::object& score) {
  const std::size_t count = robot.size();
  require(pose.shape(0) == count && twist.shape(0) == count && foot.shape(0) == count && begin.size() == count &&
              end.size() == count && yaw.size() == count && speed.size() == count,
          "one row of everything for each robot");
  std::vector<Request> requests(count);
  const auto all = rows<Point>(points);
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = begin.data()[i], last = end.data()[i];
    require(robot.data()[i] >= 0 && static_cast<std::size_t>(robot.data()[i]) < self.size(), "there is no such robot");
    require(0 <= first && first <= last && static_cast<std::size_t>(last) <= all.size(), "a path beyond the points");
    const Path path{rows<Point>(foot)[i],
                    all.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first)), yaw.data()[i],
                    speed.data()[i], tolerance};
    requests[i] = {static_cast<std::size_t>(robot.data()[i]), rows<Pose>(pose)[i], rows<Twist>(twist)[i], path};
  }
  Extra extra;
  if (!score.is_none()) {
    extra = [&](std::size_t index, const Trajectories& found, std::span<double> totals) {
      const nb::gil_scoped_acquire acquire;
      const auto added = nb::cast<Vector<double>>(score(index, twists_array(found), poses_array(found)));
      require(added.size() == totals.size(), "one score for each trajectory");
      for (std::size_t i = 0; i < totals.size(); ++i) totals[i] += added.data()[i];
    };
  }
  std::vector<double> result(2 * count);
  {
    const nb::gil_scoped_release release;
    self.command(now, requests, {reinterpret_cast<Twist*>(result.data()), count}, extra);
  }
  return own(std::move(result), {count, 2});
}

nb::dict explain(const Fleet& self, std::size_t robot) {
  const Dwb& dwb = self.dwb(robot);
  const std::size_t count = dwb.trajectories().size();
  nb::dict result;
  nb::list critics, reasons;
  for (const auto& it : dwb.critics()) critics.append(it.name);
  for (std::size_t i = 0; i < count; ++i) {
    const int critic = dwb.droppers()[i];
    if (critic < 0) {
      reasons.append("");
    } else {
      reasons.append(dwb.critics()[static_cast<std::size_t>(critic)].name + ": " + dwb.reasons()[i]);
    }
  }
  result["critics"] = critics;
  result["twist"] = twists_array(dwb.trajectories());
  result["pose"] = poses_array(dwb.trajectories());
  result["score"] = own(dwb.scores(), {dwb.critics().size(), count});
  result["total"] = own(dwb.totals(), {count});
  result["reason"] = reasons;
  return result;
}

std::tuple<Output, double, double, double> costmap(const Fleet& self, std::size_t robot) {
  const Costmap& map = self.costmap(robot);
  const Frame& frame = map.frame();
  return {own<double>({map.costs().begin(), map.costs().end()},
                      {static_cast<std::size_t>(frame.height), static_cast<std::size_t>(frame.width)}),
          frame.origin.x * frame.resolution, frame.origin.y * frame.resolution, map.inscribed()};
}

}  // namespace

NB_MODULE(local, module) {
  module.doc() = "Local navigation in C++: costmaps, and Nav2's DWB.";

  nb::class_<Fleet>(module, "Fleet")
      .def(
          "__init__",
          [](Fleet* self, const Matrix<4>& walls, double reach, int threads) {
            new (self) Fleet(copy<Segment>(walls), reach, threads);
          },
          nb::kw_only(), "walls"_a, "reach"_a, "threads"_a)
      .def("add", &add, nb::kw_only(), "settings"_a, "footprint"_a, "critics"_a)
      .def("see", &see, "now"_a, "robots"_a, "pose"_a, "ranges"_a)
      .def("command", &command, nb::kw_only(), "now"_a, "robot"_a, "pose"_a, "twist"_a, "foot"_a, "points"_a, "begin"_a,
           "end"_a, "yaw"_a, "speed"_a, "tolerance"_a, "score"_a = nb::none())
      .def("clear", &Fleet::clear, "robot"_a)
      .def("is_free",
           [](const Fleet& self, std::size_t robot, const Matrix<3>& poses) {
             std::vector<double> free;
             for (const Pose& pose : rows<Pose>(poses)) free.push_back(self.is_free(robot, pose) ? 1 : 0);
             return own(free, {free.size()});
           })
      .def("reroute", [](const Fleet& self, std::size_t robot, double x, double y,
                         const Matrix<2>& path) { return way_array(self.reroute(robot, {x, y}, whole(path))); })
      .def("approach", [](const Fleet& self, std::size_t robot, double x, double y, const Matrix<2>& path,
                          double tolerance) { return way_array(self.approach(robot, {x, y}, whole(path), tolerance)); })
      .def("explain", &explain, "robot"_a)
      .def("costmap", &costmap, "robot"_a);

  module.def(
      "critic", [](const std::string& name, const Settings& options) { make_critic(name, options); }, "name"_a,
      "options"_a);
}
