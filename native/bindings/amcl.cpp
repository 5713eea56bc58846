// Python bindings of localisation: arrays in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <stdexcept>
#include <string>

#include "arrays.hpp"
#include "mrpbench_amcl/fleet.hpp"
#include "options.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::amcl;
using mrpbench::sim::Segment;

namespace {

using Output = nb::ndarray<nb::numpy, double>;

static_assert(sizeof(Segment) == 4 * sizeof(double) && sizeof(Pose) == 3 * sizeof(double));
static_assert(sizeof(Point) == 2 * sizeof(double));

void construct(Fleet* self, const Matrix<4>& segments, double resolution, const Matrix<2>& places,
               const Matrix<3>& placements, std::uint64_t seed, const nb::dict& given) {
  const auto walls = rows<Segment>(segments);
  const auto free = rows<Point>(places);
  const auto poses = rows<Pose>(placements);
  const auto chosen = configured_by<Parameters>(given);
  const nb::gil_scoped_release release;
  new (self) Fleet({walls.begin(), walls.end()}, resolution, Places{{free.begin(), free.end()}, resolution},
                   {poses.begin(), poses.end()}, chosen, seed);
}

void sense(Fleet& self, const Vector<std::int32_t>& robots, const Table<double>& ranges, const Matrix<3>& odometry,
           double range, double min_range, double forward, double leftward) {
  require(ranges.shape(0) == robots.size(), "one row of ranges for each robot");
  const Scans scans{
      {robots.data(), robots.size()}, {ranges.data(), ranges.size()}, range, min_range, {forward, leftward}};
  const nb::gil_scoped_release release;
  self.sense(scans, rows<Pose>(odometry));
}

Output poses(const Fleet& self, const Matrix<3>& odometry) {
  require(odometry.shape(0) == self.size(), "one odometry pose for each robot");
  std::vector<double> values;
  for (std::size_t robot = 0; robot < self.size(); ++robot) {
    const Pose pose = self.pose(robot, rows<Pose>(odometry)[robot]);
    values.insert(values.end(), {pose.x, pose.y, pose.yaw});
  }
  return own(std::move(values), {self.size(), 3});
}

Output covariances(const Fleet& self) {
  std::vector<double> values;
  for (std::size_t robot = 0; robot < self.size(); ++robot) {
    const auto& covariance = self.estimate(robot).covariance;
    values.insert(values.end(), covariance.begin(), covariance.end());
  }
  return own(std::move(values), {self.size(), 3, 3});
}

Output particles(const Fleet& self, std::size_t robot) {
  require(robot < self.size(), "there is no such robot");
  const auto found = self.particles(robot);
  std::vector<double> values;
  for (const Particle& it : found) values.insert(values.end(), {it.pose.x, it.pose.y, it.pose.yaw, it.weight});
  return own(std::move(values), {found.size(), 4});
}

}  // namespace

NB_MODULE(amcl, module) {
  use_options();
  module.doc() = "Adaptive Monte Carlo localisation of a fleet, in C++.";

  nb::class_<Fleet>(module, "Fleet")
      .def("__init__", &construct, nb::kw_only(), "segments"_a, "resolution"_a, "places"_a, "placements"_a, "seed"_a,
           "parameters"_a)
      .def(
          "begin", [](Fleet& self, const Matrix<3>& odometry) { self.begin(rows<Pose>(odometry)); }, "odometry"_a)
      .def("sense", &sense, "robots"_a, "ranges"_a, "odometry"_a, nb::kw_only(), "range"_a, "min_range"_a, "forward"_a,
           "leftward"_a)
      .def("poses", &poses, "odometry"_a, nb::rv_policy::automatic)
      .def_prop_ro("covariances", &covariances, nb::rv_policy::automatic)
      .def("particles", &particles, "robot"_a, nb::rv_policy::automatic);

  module.def("options", [] { return parameters(Parameters::description()); });
}
