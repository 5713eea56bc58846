// Python bindings of the simulator: arrays in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>

#include "arrays.hpp"
#include "mrpbench_sim/caster.hpp"
#include "mrpbench_sim/plane.hpp"
#include "options.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::sim;

namespace {

template <class T>
using Output = nb::ndarray<nb::numpy, T>;

static_assert(sizeof(Segment) == 4 * sizeof(double) && sizeof(Pose) == 3 * sizeof(double));
static_assert(sizeof(Twist) == 2 * sizeof(double) && sizeof(Point) == 2 * sizeof(double));

template <class T, class Row>
Output<T> copied(const std::vector<Row>& rows_of) {
  constexpr std::size_t columns = sizeof(Row) / sizeof(T);
  const auto* const first = reinterpret_cast<const T*>(rows_of.data());
  return own<T>({first, first + rows_of.size() * columns}, {rows_of.size(), columns});
}

void construct_plane(Plane* self, const Matrix<4>& segments, const nb::dict& robots, const Vector<double>& movers,
                     double period, const nb::dict& noise, std::uint64_t seed) {
  const NamedArrays arrays(robots, "robots");
  const auto pose = arrays.rows<3>("pose");
  const std::size_t count = pose.shape(0);
  const auto limit = arrays.rows<2>("limit", count), acceleration = arrays.rows<2>("acceleration", count);
  const auto wheel_separation = arrays.vector<double>("wheel_separation", count);
  auto radius = copy<double>(arrays.vector<double>("radius", count));
  radius.insert(radius.end(), movers.data(), movers.data() + movers.size());
  std::vector<Drive> drives;
  for (std::size_t i = 0; i < count; ++i) {
    drives.push_back({rows<Twist>(limit)[i], rows<Twist>(acceleration)[i], wheel_separation.data()[i]});
  }
  auto chance = configured_by<Chance>(noise);
  chance.seed = seed;
  new (self) Plane(copy<Segment>(segments), std::move(radius), std::move(drives), copy<Pose>(pose), period, chance);
}

void construct_caster(Caster* self, const Matrix<4>& segments, nb::handle lidar) {
  const auto [forward, leftward, height] = attribute<std::tuple<double, double, double>>(lidar, "mount");
  new (self) Caster(copy<Segment>(segments), {attribute<int>(lidar, "beams"),
                                              attribute<double>(lidar, "range"),
                                              attribute<double>(lidar, "min_range"),
                                              {forward, leftward}});
}

void step(Plane& self, const Matrix<2>& twist, const std::optional<Matrix<2>>& movers) {
  require(!movers || movers->shape(0) == self.mover_count(), "one place for each mover");
  const auto places = movers ? rows<Point>(*movers) : std::span<const Point>{};
  const nb::gil_scoped_release release;
  self.step(rows<Twist>(twist), places);
}

Output<double> scan(const Caster& self, const Vector<std::int32_t>& robots, const Matrix<3>& pose,
                    const Matrix<2>& movers, const Vector<double>& radius, const std::optional<Matrix<4>>& leaves) {
  const std::size_t count = pose.shape(0), beams = static_cast<std::size_t>(self.beams());
  require(radius.size() == count + movers.shape(0), "each robot and mover has a radius");
  for (const std::int32_t robot : rows<std::int32_t>(robots)) {
    require(robot >= 0 && static_cast<std::size_t>(robot) < count, "there is no such robot");
  }
  std::vector<double> ranges(robots.size() * beams);
  {
    const nb::gil_scoped_release release;
    std::vector<Point> centres;
    for (const Pose& it : rows<Pose>(pose)) centres.push_back({it.x, it.y});
    for (const Point& it : rows<Point>(movers)) centres.push_back(it);
    self.scan(rows<std::int32_t>(robots), rows<Pose>(pose), centres, rows<double>(radius),
              leaves ? rows<Segment>(*leaves) : std::span<const Segment>{}, ranges);
  }
  return own(std::move(ranges), {robots.size(), beams});
}

}  // namespace

NB_MODULE(sim, module) {
  use_options();
  module.doc() = "Robots, contacts and lidars in the plane, in C++.";

  nb::class_<Plane>(module, "Plane")
      .def("__init__", &construct_plane, nb::kw_only(), "segments"_a, "robots"_a, "movers"_a, "period"_a, "noise"_a,
           "seed"_a)
      .def("step", &step, "twist"_a, "movers"_a = nb::none())
      .def(
          "set_leaves", [](Plane& self, const Matrix<4>& segments) { self.set_leaves(rows<Segment>(segments)); },
          "segments"_a)
      .def(
          "place", [](Plane& self, int robot, double x, double y) { self.place(robot, {x, y}); }, "robot"_a, "x"_a,
          "y"_a)
      .def_prop_ro(
          "pose", [](const Plane& self) { return copied<double>(self.poses()); }, nb::rv_policy::automatic)
      .def_prop_ro(
          "twist", [](const Plane& self) { return copied<double>(self.twists()); }, nb::rv_policy::automatic)
      .def_prop_ro(
          "contacts", [](const Plane& self) { return copied<std::int32_t>(self.touches()); }, nb::rv_policy::automatic);

  nb::class_<Caster>(module, "Caster")
      .def("__init__", &construct_caster, nb::kw_only(), "segments"_a, "lidar"_a)
      .def("scan", &scan, "robots"_a, "pose"_a, "movers"_a, "radius"_a, "leaves"_a = nb::none());

  module.def("noise_options", [] { return parameters(Chance::description()); });
}
