// Python bindings of localisation: arrays in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "arrays.hpp"
#include "mrpbench_amcl/fleet.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::amcl;
using mrpbench::sim::Segment;

namespace {

using Table = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Output = nb::ndarray<nb::numpy, double>;

static_assert(sizeof(Segment) == 4 * sizeof(double) && sizeof(Pose) == 3 * sizeof(double));
static_assert(sizeof(Point) == 2 * sizeof(double));

/// A new array that owns its values.
Output own(std::unique_ptr<double[]> values, std::initializer_list<std::size_t> shape) {
  double* const data = values.release();
  nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<double*>(p); });
  return Output(data, shape, owner);
}

Parameters parameters(const nb::dict& given) {
  Parameters result;
  std::map<std::string, double*> numbers{
      {"alpha1", &result.alpha1},
      {"alpha2", &result.alpha2},
      {"alpha3", &result.alpha3},
      {"alpha4", &result.alpha4},
      {"z_hit", &result.z_hit},
      {"z_rand", &result.z_rand},
      {"sigma_hit", &result.sigma_hit},
      {"laser_likelihood_max_dist", &result.laser_likelihood_max_dist},
      {"pf_err", &result.pf_err},
      {"pf_z", &result.pf_z},
      {"update_min_d", &result.update_min_d},
      {"update_min_a", &result.update_min_a},
      {"recovery_alpha_slow", &result.recovery_alpha_slow},
      {"recovery_alpha_fast", &result.recovery_alpha_fast},
      {"initial_cov_xx", &result.initial_cov_xx},
      {"initial_cov_yy", &result.initial_cov_yy},
      {"initial_cov_aa", &result.initial_cov_aa},
  };
  std::map<std::string, int*> counts{
      {"max_beams", &result.max_beams},
      {"min_particles", &result.min_particles},
      {"max_particles", &result.max_particles},
      {"resample_interval", &result.resample_interval},
  };
  for (const auto& [key, value] : given) {
    const auto name = nb::cast<std::string>(key);
    if (name == "independent_beams") {
      result.independent_beams = nb::cast<bool>(value);
      continue;
    }
    if (const auto number = numbers.find(name); number != numbers.end()) {
      *number->second = nb::cast<double>(value);
    } else if (const auto count = counts.find(name); count != counts.end()) {
      *count->second = nb::cast<int>(value);
    } else {
      throw std::invalid_argument("there is no parameter " + name);
    }
  }
  return result;
}

void construct(Fleet* self, const Matrix<4>& segments, double resolution, const Matrix<2>& places,
               const Matrix<3>& placements, std::uint64_t seed, const nb::dict& given) {
  const auto walls = rows<Segment>(segments);
  const auto free = rows<Point>(places);
  const auto poses = rows<Pose>(placements);
  const Parameters chosen = parameters(given);
  const nb::gil_scoped_release release;
  new (self) Fleet({walls.begin(), walls.end()}, resolution, Places{{free.begin(), free.end()}, resolution},
                   {poses.begin(), poses.end()}, chosen, seed);
}

void sense(Fleet& self, const Vector<std::int32_t>& robots, const Table& ranges, const Matrix<3>& odometry,
           double range, double min_range, double forward, double leftward) {
  if (ranges.shape(0) != robots.size()) throw std::invalid_argument("one row of ranges for each robot");
  const Scans scans{
      {robots.data(), robots.size()}, {ranges.data(), ranges.size()}, range, min_range, {forward, leftward}};
  const nb::gil_scoped_release release;
  self.sense(scans, rows<Pose>(odometry));
}

Output poses(const Fleet& self, const Matrix<3>& odometry) {
  if (odometry.shape(0) != self.size()) throw std::invalid_argument("one odometry pose for each robot");
  auto values = std::make_unique_for_overwrite<double[]>(self.size() * 3);
  for (std::size_t robot = 0; robot < self.size(); ++robot) {
    const Pose pose = self.pose(robot, rows<Pose>(odometry)[robot]);
    values[robot * 3] = pose.x;
    values[robot * 3 + 1] = pose.y;
    values[robot * 3 + 2] = pose.yaw;
  }
  return own(std::move(values), {self.size(), 3});
}

Output covariances(const Fleet& self) {
  auto values = std::make_unique_for_overwrite<double[]>(self.size() * 9);
  for (std::size_t robot = 0; robot < self.size(); ++robot) {
    std::copy_n(self.estimate(robot).covariance.data(), 9, values.get() + robot * 9);
  }
  return own(std::move(values), {self.size(), 3, 3});
}

Output particles(const Fleet& self, std::size_t robot) {
  if (robot >= self.size()) throw std::invalid_argument("there is no such robot");
  const auto found = self.particles(robot);
  auto values = std::make_unique_for_overwrite<double[]>(found.size() * 4);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Particle& it = found[i];
    const double row[4] = {it.pose.x, it.pose.y, it.pose.yaw, it.weight};
    std::copy_n(row, 4, values.get() + 4 * i);
  }
  return own(std::move(values), {found.size(), 4});
}

}  // namespace

NB_MODULE(amcl, module) {
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
}
