// Python bindings of local navigation: arrays in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <stdexcept>

#include "arrays.hpp"
#include "mrpbench_local/costmap/footprint.hpp"
#include "mrpbench_local/fleet.hpp"
#include "options.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::local;
using mrpbench::OptionValues;
using mrpbench::Parameter;

namespace {

using Output = nb::ndarray<nb::numpy, double>;
using Critics = std::vector<std::tuple<std::string, double, nb::dict>>;

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

/// The entries of `given` that are among `options`, or those that are not.
nb::dict selected(const nb::dict& given, const std::vector<Parameter>& options, bool among) {
  nb::dict found;
  for (const auto& [key, value] : given) {
    const auto name = nb::cast<std::string>(key);
    const auto is_it = [&](const Parameter& it) { return it.info.name == name; };
    if (std::ranges::any_of(options, is_it) == among) found[key] = value;
  }
  return found;
}

RobotOptions of_robot(const nb::dict& settings, const Matrix<2>& footprint) {
  auto options = configured_by<RobotOptions>(selected(settings, parameters(RobotOptions::description()), true));
  options.costmap.footprint = padded(options.by_radius ? rounded(options.robot_radius) : copy<Point>(footprint),
                                     options.costmap.footprint_padding);
  return options;
}

void add(Fleet& self, const std::string& controller, const nb::dict& settings, const Matrix<2>& footprint,
         const Critics& critics, std::uint64_t seed) {
  const ControllerKind& kind = controller_kind(controller);
  std::vector<CriticChoice> chosen;
  for (const auto& [name, weight, given] : critics) {
    require(static_cast<bool>(kind.critic_options), "this controller has no critics");
    chosen.push_back({name, weight, from_python(given, kind.critic_options(name))});
  }
  std::vector<Parameter> own = kind.nav2;
  for (const auto* group : {&kind.further, &kind.derived}) own.insert(own.end(), group->begin(), group->end());
  const OptionValues values = from_python(selected(settings, parameters(RobotOptions::description()), false), own);
  const RobotOptions options = of_robot(settings, footprint);
  self.add(options, kind.make(values, options, {seed, self.size()}, chosen));
}

void see(Fleet& self, double now, const Vector<std::int32_t>& robots, const Matrix<3>& poses,
         const nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>& ranges) {
  require(ranges.shape(0) == robots.size() && poses.shape(0) == self.size(), "a scan for each robot, a pose for all");
  for (const std::int32_t robot : rows<std::int32_t>(robots)) {
    require(robot >= 0 && static_cast<std::size_t>(robot) < self.size(), "there is no such robot");
  }
  auto owner = keeping(robots, poses, ranges);
  const nb::gil_scoped_release release;
  self.see(now, rows<std::int32_t>(robots), rows<Pose>(poses), {ranges.data(), ranges.size()}, std::move(owner));
}

/// The forecast of each robot; `robots` are those of the objects, in ascending order.
void foresee(Fleet& self, const Vector<std::int32_t>& robots,
             const nb::ndarray<const double, nb::shape<-1, -1, 2>, nb::c_contig, nb::device::cpu>& places,
             const Vector<double>& radius, double step) {
  const std::size_t size = robots.size(), count = places.shape(1);
  require(places.shape(0) == size && radius.size() == size && count > 1 && step > 0, "places and a radius for each");
  const auto* const all = reinterpret_cast<const Point*>(places.data());
  for (std::size_t first = 0, last = 0; first < size; first = last) {
    const std::int32_t robot = robots.data()[first];
    require(robot >= 0 && static_cast<std::size_t>(robot) < self.size(), "there is no such robot");
    while (last < size && robots.data()[last] == robot) ++last;
    self.foresee(
        static_cast<std::size_t>(robot),
        {step, count, {all + first * count, all + last * count}, {radius.data() + first, radius.data() + last}});
  }
}

Output array_of(const Array& array) {
  auto* const kept = new std::vector<double>(array.values);
  const nb::capsule owner(kept, [](void* it) noexcept { delete static_cast<std::vector<double>*>(it); });
  return Output(kept->data(), array.shape.size(), array.shape.data(), owner);
}

/// `seen` is an object with the attributes of `Observations`.
Output command(Fleet& self, nb::handle seen, const nb::object& score) {
  const auto robot = attribute<Vector<std::int64_t>>(seen, "robot");
  const auto pose = attribute<Matrix<3>>(seen, "pose");
  const auto twist = attribute<Matrix<2>>(seen, "twist"), foot = attribute<Matrix<2>>(seen, "foot");
  const auto points = attribute<Matrix<2>>(seen, "points");
  const auto begin = attribute<Vector<std::int64_t>>(seen, "begin"), end = attribute<Vector<std::int64_t>>(seen, "end");
  const auto yaw = attribute<Vector<double>>(seen, "yaw"), speed = attribute<Vector<double>>(seen, "speed");
  const auto now = attribute<double>(seen, "now"), tolerance = attribute<double>(seen, "tolerance");
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
  ExtraOfRobot extra;
  if (!score.is_none()) {
    extra = [&](std::size_t index, const Samples& found, std::span<double> totals) {
      const nb::gil_scoped_acquire acquire;
      const auto added = nb::cast<Vector<double>>(score(index, array_of(found.twist), array_of(found.pose)));
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
  const Explanation found = self.explain(robot);
  nb::dict result;
  for (const auto& [name, array] : found.arrays) result[name.c_str()] = array_of(array);
  for (const auto& [name, words] : found.words) result[name.c_str()] = nb::cast(words);
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
  use_options();
  module.doc() = "Local navigation in C++: costmaps, and Nav2's controllers.";

  nb::class_<Fleet>(module, "Fleet")
      .def(
          "__init__",
          [](Fleet* self, const Matrix<4>& walls, double reach, int threads) {
            new (self) Fleet(copy<Segment>(walls), reach, threads);
          },
          nb::kw_only(), "walls"_a, "reach"_a, "threads"_a)
      .def("add", &add, nb::kw_only(), "controller"_a, "settings"_a, "footprint"_a, "critics"_a = Critics{},
           "seed"_a = 0)
      .def(
          "add_costmap",
          [](Fleet& self, const nb::dict& settings, const Matrix<2>& footprint) {
            self.add(of_robot(settings, footprint), nullptr);
          },
          nb::kw_only(), "settings"_a, "footprint"_a)
      .def("see", &see, "now"_a, "robots"_a, "pose"_a, "ranges"_a)
      .def("foresee", &foresee, "robots"_a, "places"_a, "radius"_a, "step"_a)
      .def("command", &command, "seen"_a, "score"_a = nb::none())
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
      .def(
          "plan",
          [](Fleet& self, double now, std::size_t robot, const Matrix<3>& pose, const Matrix<2>& goal,
             double tolerance) {
            require(pose.shape(0) == 1 && goal.shape(0) == 1, "one pose and one goal");
            return way_array(self.plan(now, robot, rows<Pose>(pose)[0], rows<Point>(goal)[0], tolerance));
          },
          "now"_a, "robot"_a, "pose"_a, "goal"_a, "tolerance"_a)
      .def("explain", &explain, "robot"_a)
      .def("costmap", &costmap, "robot"_a);

  module.def("robot_options", &robot_parameters, "group"_a);
  module.def(
      "controller_options",
      [](const std::string& name, bool further) {
        const ControllerKind& kind = controller_kind(name);
        return further ? kind.further : kind.nav2;
      },
      "name"_a, "further"_a = false);
  module.def(
      "critic_options",
      [](const std::string& controller, const std::string& name) {
        const ControllerKind& kind = controller_kind(controller);
        require(static_cast<bool>(kind.critic_options), "this controller has no critics");
        return kind.critic_options(name);
      },
      "controller"_a, "name"_a);
}
