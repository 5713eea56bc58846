// Python bindings of the navigation of fleets along routes: arrays in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <optional>

#include "arrays.hpp"
#include "mrpbench_navigation/pure_pursuit.hpp"
#include "mrpbench_navigation/survey.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::navigation;

namespace {

static_assert(sizeof(Arrival) == 6 * sizeof(double) && sizeof(Rounding) == 4 * sizeof(double));
static_assert(sizeof(Clearing) == 3 * sizeof(double) && sizeof(Leg) == 5 * sizeof(double));
static_assert(sizeof(Point) == 2 * sizeof(double) && sizeof(Twist) == 2 * sizeof(double));
static_assert(sizeof(Pose) == 3 * sizeof(double));

template <class T>
using View = nb::ndarray<nb::numpy, const T, nb::ndim<1>>;

/// The tables of `RouteTables`, by the names of its attributes.
Routes routes_of(const nb::dict& tables, std::size_t robots) {
  const NamedArrays arrays(tables, "tables");
  const auto vector = [&]<class T>(const char* name, std::size_t size, T) {
    return rows<T>(arrays.vector<T>(name, size));
  };
  const std::size_t waypoints = arrays.vector<double>("yaw").size(), corners = arrays.rows<2>("corners").shape(0);
  Routes it;
  it.first = vector("first", robots, Index{});
  it.last = vector("last", robots, Index{});
  it.goal = vector("goal", robots, Index{});
  it.first_corner = vector("first_corner", robots, Index{});
  it.last_corner = vector("last_corner", robots, Index{});
  it.corner = vector("corner", waypoints, Index{});
  it.level = vector("level", waypoints, std::int16_t{});
  it.speed = vector("speed", waypoints, double{});
  it.yaw = vector("yaw", waypoints, double{});
  it.waiting_yaw = vector("waiting_yaw", waypoints, double{});
  it.is_wait = vector("is_wait", waypoints, bool{});
  it.arrival = rows<Arrival>(arrays.rows<6>("arrival", waypoints));
  it.corners = rows<Point>(arrays.rows<2>("corners", corners));
  it.step = rows<Point>(arrays.rows<2>("step", corners));
  it.normal = rows<Point>(arrays.rows<2>("normal", corners));
  it.clearance = vector("clearance", corners, double{});
  it.distance = vector("distance", corners, double{});
  it.is_short = vector("is_short", corners, bool{});
  it.stop = vector("stop", corners, Index{});
  it.lift = vector("lift", corners, Index{});
  it.any_yaw = nb::cast<bool>(tables["any_yaw"]);
  return it;
}

/// A survey with the arrays that its routes refer to.
struct Navigation {
  Survey survey;
  nb::dict tables, activities;
  Activities flags;

  void adopt(const nb::dict& routes, const std::optional<Vector<std::int32_t>>& cut) {
    require(!cut || cut->size() == survey.follower.size(), "one number of segments for each robot");
    survey.follower.adopt(routes_of(routes, survey.follower.size()),
                          cut ? rows<std::int32_t>(*cut) : std::span<const std::int32_t>{});
    tables = routes;
    survey.read_progress();
  }
};

void construct(Navigation* self, const nb::dict& rules, const nb::dict& activities) {
  const auto number = [&](const char* name) { return nb::cast<double>(rules[name]); };
  const auto flag = [&](const char* name) { return nb::cast<bool>(rules[name]); };
  const NamedArrays arrays(activities, "activities");
  const std::size_t robots = arrays.vector<bool>("aborted").size();
  const auto flags = [&](const char* name) { return rows<bool>(arrays.vector<bool>(name, robots)); };
  const ArrivalRules arrival{flag("stops"),
                             flag("stateful"),
                             flag("beyond_bends"),
                             number("passing_tolerance"),
                             number("yaw_goal_tolerance"),
                             number("trans_stopped_velocity"),
                             number("rot_stopped_velocity")};
  const ProgressRules progress{number("required_movement_radius"), number("movement_time_allowance"),
                               number("required_movement_angle")};
  const DetourRules detours{nb::cast<Index>(rules["detours_every"]), flag("detours_always")};
  new (self) Navigation{Survey(robots, arrival, progress, detours),
                        {},
                        activities,
                        {flags("aborted"), flags("recovering"), flags("rotating"), flags("detouring")}};
}

bool update(Navigation& self, const Matrix<3>& pose, const Matrix<2>& twist, const Vector<std::int32_t>& released,
            const Vector<std::int16_t>& level) {
  const std::size_t robots = self.survey.follower.size();
  require(pose.shape(0) == robots && twist.shape(0) == robots && released.size() == robots && level.size() == robots,
          "one row for each robot");
  return self.survey.update(rows<Pose>(pose), rows<Twist>(twist), rows<std::int32_t>(released),
                            rows<std::int16_t>(level));
}

std::tuple<std::size_t, bool, std::vector<Index>, std::vector<Index>> survey(Navigation& self, double now,
                                                                             const Matrix<3>& pose,
                                                                             const Matrix<2>& twist,
                                                                             const Vector<double>& limits) {
  const std::size_t robots = self.survey.follower.size();
  require(pose.shape(0) == robots && twist.shape(0) == robots && (limits.size() == 0 || limits.size() == robots),
          "one row for each robot");
  const bool stuck = self.survey.survey(now, rows<Pose>(pose), rows<Twist>(twist), rows<double>(limits), self.flags);
  return {self.survey.row_count, stuck, self.survey.due, self.survey.blocked};
}

std::size_t checked(const Navigation& self, std::size_t robot) {
  require(robot < self.survey.follower.size(), "there is no such robot");
  return robot;
}

/// A view of one of the vectors that a navigation has as long as it lives.
template <class T, class Value>
nb::object view(nb::handle owner, const std::vector<Value>& values) {
  constexpr std::size_t columns = sizeof(Value) / sizeof(T);
  const auto* const data = reinterpret_cast<const T*>(values.data());
  if constexpr (columns == 1) {
    return nb::cast(nb::ndarray<nb::numpy, const T>(data, {values.size()}, owner), nb::rv_policy::reference);
  } else {
    return nb::cast(nb::ndarray<nb::numpy, const T>(data, {values.size(), columns}, owner), nb::rv_policy::reference);
  }
}

nb::dict state_views(nb::handle self) {
  const FleetState& state = nb::cast<Navigation&>(self).survey.state;
  nb::dict found;
  found["reached"] = view<std::int32_t>(self, state.reached);
  found["cleared"] = view<std::int32_t>(self, state.cleared);
  found["foot"] = view<double>(self, state.foot);
  found["begin"] = view<Index>(self, state.begin);
  found["end"] = view<Index>(self, state.end);
  found["yaw"] = view<double>(self, state.yaw);
  found["speed"] = view<double>(self, state.speed);
  found["under_way"] = view<std::uint8_t>(self, state.under_way);
  found["following"] = view<std::uint8_t>(self, state.following);
  found["stuck"] = view<std::uint8_t>(self, state.stuck);
  return found;
}

nb::dict row_views(nb::handle self) {
  const Rows& rows_of = nb::cast<Navigation&>(self).survey.rows;
  nb::dict found;
  found["robot"] = view<Index>(self, rows_of.robot);
  found["pose"] = view<double>(self, rows_of.pose);
  found["twist"] = view<double>(self, rows_of.twist);
  found["foot"] = view<double>(self, rows_of.foot);
  found["begin"] = view<Index>(self, rows_of.begin);
  found["end"] = view<Index>(self, rows_of.end);
  found["yaw"] = view<double>(self, rows_of.yaw);
  found["speed"] = view<double>(self, rows_of.speed);
  return found;
}

/// Pure pursuit of a fleet.
struct PurePursuit {
  PursuitOptions options;
  std::vector<PursuingRobot> robots;
  std::vector<unsigned char> turning;

  PurePursuit(const nb::dict& values, const Matrix<5>& fleet)
      : robots(copy<PursuingRobot>(fleet)), turning(fleet.shape(0)) {
    const auto number = [&](const char* name) { return nb::cast<double>(values[name]); };
    options = {number("period"),
               number("lookahead_dist"),
               nb::cast<bool>(values["use_rotate_to_heading"]),
               nb::cast<bool>(values["use_regulated_linear_velocity_scaling"]),
               number("rotate_to_heading_min_angle"),
               number("angular_disengage_threshold"),
               number("regulated_linear_scaling_min_radius"),
               number("regulated_linear_scaling_min_speed")};
  }
};
static_assert(sizeof(PursuingRobot) == 5 * sizeof(double));

nb::ndarray<nb::numpy, double> command(PurePursuit& self, const Vector<Index>& robot, const Matrix<3>& pose,
                                       const Matrix<2>& twist, const Matrix<2>& foot, const Matrix<2>& points,
                                       const Vector<Index>& begin, const Vector<Index>& end, const Vector<double>& yaw,
                                       const Vector<double>& speed) {
  const std::size_t count = robot.size();
  for (const std::size_t size :
       {pose.shape(0), twist.shape(0), foot.shape(0), begin.size(), end.size(), yaw.size(), speed.size()}) {
    require(size == count, "one row for each robot");
  }
  constexpr std::size_t soon = 8;  // the paths of a fleet do not fit the cache
  const auto all = rows<Point>(points);
  std::vector<double> commands;
  commands.reserve(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto which = static_cast<std::size_t>(robot.data()[i]);
    const auto from = static_cast<std::size_t>(begin.data()[i]), to = static_cast<std::size_t>(end.data()[i]);
    require(which < self.robots.size(), "there is no such robot");
    require(from < to && to <= all.size(), "a path has a point");
    if (i + soon < count) __builtin_prefetch(&all[static_cast<std::size_t>(begin.data()[i + soon]) % all.size()]);
    bool turning = self.turning[which] != 0;
    const Twist twist_of = pursue(self.options, self.robots[which],
                                  {rows<Pose>(pose)[i], rows<Twist>(twist)[i], rows<Point>(foot)[i],
                                   all.subspan(from, to - from), yaw.data()[i], speed.data()[i]},
                                  turning);
    self.turning[which] = turning;
    commands.insert(commands.end(), {twist_of.ahead, twist_of.turn});
  }
  return own(std::move(commands), {count, 2});
}

}  // namespace

NB_MODULE(navigation, module) {
  module.doc() = "Fleets that follow routes, in C++.";

  nb::class_<Navigation>(module, "Navigation")
      .def("__init__", &construct, nb::kw_only(), "rules"_a, "activities"_a)
      .def("adopt", &Navigation::adopt, "tables"_a, "cut"_a = nb::none())
      .def("update", &update, "pose"_a, "twist"_a, "released"_a, "level"_a)
      .def("survey", &survey, "now"_a, "pose"_a, "twist"_a, "limits"_a)
      .def(
          "rejoin",
          [](Navigation& self, std::size_t robot, double x, double y) {
            self.survey.follower.rejoin(checked(self, robot), {x, y});
            self.survey.read_progress();
          },
          "robot"_a, "x"_a, "y"_a)
      .def(
          "skip_path_end",
          [](Navigation& self, std::size_t robot) {
            self.survey.follower.skip_path_end(checked(self, robot));
            self.survey.read_progress();
          },
          "robot"_a)
      .def(
          "only_turns",
          [](const Navigation& self, std::size_t robot) {
            const Progress& it = self.survey.follower.progress(checked(self, robot));
            return it.at_goal && it.reached < it.released;
          },
          "robot"_a)
      .def(
          "hurry", [](Navigation& self, std::size_t robot) { self.survey.hurry(checked(self, robot)); }, "robot"_a)
      .def_prop_ro("state", &state_views)
      .def_prop_ro("rows", &row_views);

  nb::class_<ProgressChecker>(module, "ProgressChecker")
      .def(
          "__init__",
          [](ProgressChecker* self, std::size_t robots, double radius, double allowance, double angle) {
            new (self) ProgressChecker(robots, {radius, allowance, angle});
          },
          "robots"_a, "radius"_a, "allowance"_a, "angle"_a)
      .def("begin", &ProgressChecker::begin, "now"_a)
      .def(
          "is_stuck",
          [](ProgressChecker& self, std::size_t robot, double x, double y, double yaw, bool under_way, double speed) {
            return self.is_stuck(robot, {x, y, yaw}, under_way, speed);
          },
          "robot"_a, "x"_a, "y"_a, "yaw"_a, "under_way"_a, "speed"_a);

  nb::class_<PurePursuit>(module, "PurePursuit")
      .def(nb::init<const nb::dict&, const Matrix<5>&>(), nb::kw_only(), "options"_a, "robots"_a)
      .def("command", &command, "robot"_a, "pose"_a, "twist"_a, "foot"_a, "points"_a, "begin"_a, "end"_a, "yaw"_a,
           "speed"_a);
}
