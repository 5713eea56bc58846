// Python bindings of the simulator: arrays in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>

#include "arrays.hpp"
#include "mrpbench_sim/caster.hpp"
#include "mrpbench_sim/plane.hpp"
#include "mrpbench_sim/walkers.hpp"
#include "mrpbench_sim/walking_routes.hpp"
#include "options.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::sim;

namespace {

/// An array that a function writes into.
template <int columns>
using Written = nb::ndarray<double, nb::shape<-1, columns>, nb::c_contig, nb::device::cpu>;
template <class T>
using Output = nb::ndarray<nb::numpy, T>;

static_assert(sizeof(Segment) == 4 * sizeof(double) && sizeof(Pose) == 3 * sizeof(double));
static_assert(sizeof(Walker) == 4 * sizeof(double));
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

void construct_caster(Caster* self, const Matrix<4>& segments, nb::handle lidar, int threads) {
  const auto [forward, leftward, height] = attribute<std::tuple<double, double, double>>(lidar, "mount");
  new (self) Caster(copy<Segment>(segments),
                    {attribute<int>(lidar, "beams"),
                     attribute<double>(lidar, "range"),
                     attribute<double>(lidar, "min_range"),
                     {forward, leftward}},
                    threads);
}

void step(Plane& self, const Matrix<2>& twist, const std::optional<Matrix<2>>& movers) {
  require(!movers || movers->shape(0) == self.mover_count(), "one place for each mover");
  const auto places = movers ? rows<Point>(*movers) : std::span<const Point>{};
  const nb::gil_scoped_release release;
  self.step(rows<Twist>(twist), places);
}

/// Write where robots are, and how fast they drive, into arrays; tell how many contacts there were.
std::size_t observe(const Plane& self, const Written<3>& pose, const Written<2>& twist) {
  const auto& poses = self.poses();
  const auto& twists = self.twists();
  require(pose.shape(0) == poses.size() && twist.shape(0) == poses.size(), "one row for each robot");
  std::ranges::copy(poses, reinterpret_cast<Pose*>(pose.data()));
  std::ranges::copy(twists, reinterpret_cast<Twist*>(twist.data()));
  return self.touches().size();
}

/// Begin to write the ranges of `robots` into an array.
void begin_scan(Caster& self, const Written<-1>& ranges, const Vector<std::int32_t>& robots, const Matrix<3>& pose,
                const Matrix<2>& movers, const Vector<double>& radius, const std::optional<Matrix<4>>& leaves,
                const std::optional<Matrix<4>>& sides, const std::optional<Vector<std::int32_t>>& first) {
  const std::size_t count = pose.shape(0);
  require(radius.size() == count + movers.shape(0), "each robot and mover has a radius");
  require(ranges.shape(0) == robots.size() && ranges.shape(1) == static_cast<std::size_t>(self.beams()),
          "one row of beams for each robot");
  for (const std::int32_t robot : rows<std::int32_t>(robots)) {
    require(robot >= 0 && static_cast<std::size_t>(robot) < count, "there is no such robot");
  }
  Outlines outlines;
  if (sides && first) {
    outlines = {rows<Segment>(*sides), rows<std::int32_t>(*first)};
    require(outlines.first.size() == count + 1 && outlines.first.front() == 0 &&
                std::ranges::is_sorted(outlines.first) &&
                static_cast<std::size_t>(outlines.first.back()) == outlines.sides.size(),
            "`first` gives each robot its part of `sides`");
  }
  auto owner = keeping(ranges, robots, pose, radius, leaves, sides, first);
  const nb::gil_scoped_release release;
  std::vector<Point> centres;
  for (const Pose& it : rows<Pose>(pose)) centres.push_back({it.x, it.y});
  for (const Point& it : rows<Point>(movers)) centres.push_back(it);
  self.begin(rows<std::int32_t>(robots), rows<Pose>(pose), std::move(centres), rows<double>(radius),
             leaves ? rows<Segment>(*leaves) : std::span<const Segment>{}, outlines, {ranges.data(), ranges.size()},
             std::move(owner));
}

Output<double> scan(Caster& self, const Vector<std::int32_t>& robots, const Matrix<3>& pose, const Matrix<2>& movers,
                    const Vector<double>& radius, const std::optional<Matrix<4>>& leaves,
                    const std::optional<Matrix<4>>& sides, const std::optional<Vector<std::int32_t>>& first) {
  const std::size_t beams = static_cast<std::size_t>(self.beams());
  const auto ranges = own(std::vector<double>(robots.size() * beams), {robots.size(), beams});
  begin_scan(self, Written<-1>(ranges), robots, pose, movers, radius, leaves, sides, first);
  const nb::gil_scoped_release release;
  self.finish();
  return ranges;
}

void construct_walkers(Walkers* self, const Matrix<4>& segments, const nb::dict& people, const nb::dict& options,
                       bool orca) {
  const NamedArrays arrays(people, "people");
  const auto place = arrays.rows<2>("place");
  const std::size_t count = place.shape(0);
  auto chosen = configured_by<WalkerOptions>(options);
  chosen.orca = orca;
  new (self) Walkers(copy<Segment>(segments), copy<double>(arrays.vector<double>("radius", count)),
                     copy<double>(arrays.vector<double>("speed", count)),
                     copy<int>(arrays.vector<std::int32_t>("group", count)), copy<Point>(place), chosen);
}

void walk(Walkers& self, double dt, const nb::dict& wishes, const Matrix<4>& others, const Vector<double>& radius,
          std::size_t robots, const Matrix<4>& leaves) {
  const NamedArrays arrays(wishes, "wishes");
  const auto velocity = arrays.rows<2>("velocity", self.size()), push = arrays.rows<2>("push", self.size());
  const auto regard = arrays.vector<std::uint8_t>("regard", self.size());
  const nb::gil_scoped_release release;
  self.step(dt, {rows<Point>(velocity), rows<Point>(push), rows<unsigned char>(regard)}, rows<Walker>(others),
            rows<double>(radius), robots, rows<Segment>(leaves));
}

Output<std::int32_t> routes(const Table<std::uint8_t>& free, int goal) {
  const auto rows_of = static_cast<int>(free.shape(0)), columns = static_cast<int>(free.shape(1));
  std::vector<std::int32_t> next;
  {
    const nb::gil_scoped_release release;
    next = walking_routes({free.data(), free.size()}, rows_of, columns, goal);
  }
  const std::size_t size = next.size();
  return own(std::move(next), {size});
}

}  // namespace

NB_MODULE(sim, module) {
  use_options();
  module.doc() = "Robots, contacts and lidars in the plane, in C++.";

  nb::class_<Plane>(module, "Plane")
      .def("__init__", &construct_plane, nb::kw_only(), "segments"_a, "robots"_a, "movers"_a, "period"_a, "noise"_a,
           "seed"_a)
      .def("step", &step, "twist"_a, "movers"_a = nb::none())
      .def("observe", &observe, "pose"_a.noconvert(), "twist"_a.noconvert())
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
      .def("__init__", &construct_caster, nb::kw_only(), "segments"_a, "lidar"_a, "threads"_a = 1)
      .def("scan", &scan, "robots"_a, "pose"_a, "movers"_a, "radius"_a, "leaves"_a = nb::none(), "sides"_a = nb::none(),
           "first"_a = nb::none())
      .def("begin", &begin_scan, "ranges"_a.noconvert(), "robots"_a, "pose"_a, "movers"_a, "radius"_a,
           "leaves"_a = nb::none(), "sides"_a = nb::none(), "first"_a = nb::none())
      .def("finish", &Caster::finish, nb::call_guard<nb::gil_scoped_release>());

  nb::class_<Walkers>(module, "Walkers")
      .def("__init__", &construct_walkers, nb::kw_only(), "segments"_a, "people"_a, "options"_a, "orca"_a)
      .def("step", &walk, "dt"_a, "wishes"_a, "others"_a, "radius"_a, "robots"_a, "leaves"_a)
      .def_prop_ro(
          "place", [](const Walkers& self) { return copied<double>(self.places()); }, nb::rv_policy::automatic)
      .def_prop_ro(
          "velocity", [](const Walkers& self) { return copied<double>(self.velocities()); }, nb::rv_policy::automatic);

  module.def("walking_routes", &routes, "free"_a, "goal"_a);
  module.def("walker_options", [] { return parameters(WalkerOptions::description()); });
  module.def("noise_options", [] { return parameters(Chance::description()); });
}
