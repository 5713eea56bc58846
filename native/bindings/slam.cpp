// Python bindings of localisation and mapping: arrays in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <stdexcept>
#include <string>

#include "arrays.hpp"
#include "mrpbench_slam/fleet.hpp"
#include "options.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::slam;

namespace {

using Output = nb::ndarray<nb::numpy, double>;

static_assert(sizeof(Pose) == 3 * sizeof(double));

void construct(Fleet* self, const Matrix<3>& placements, const nb::dict& given) {
  const auto poses = rows<Pose>(placements);
  const auto chosen = configured_by<Parameters>(given);
  const nb::gil_scoped_release release;
  new (self) Fleet({poses.begin(), poses.end()}, chosen);
}

void sense(Fleet& self, const Vector<std::int32_t>& robots, const Table<double>& ranges, const Matrix<3>& odometry,
           double now, double range, double min_range, double forward, double leftward) {
  require(ranges.shape(0) == robots.size(), "one row of ranges for each robot");
  const Scans scans{
      {robots.data(), robots.size()}, {ranges.data(), ranges.size()}, {range, min_range, {forward, leftward}}};
  const nb::gil_scoped_release release;
  self.sense(scans, rows<Pose>(odometry), now);
}

Output array_of(const std::vector<Pose>& poses) {
  std::vector<double> values;
  for (const Pose& it : poses) values.insert(values.end(), {it.x, it.y, it.yaw});
  return own(std::move(values), {poses.size(), 3});
}

Output poses(const Fleet& self, const Matrix<3>& odometry) {
  require(odometry.shape(0) == self.size(), "one odometry pose for each robot");
  std::vector<Pose> found;
  for (std::size_t robot = 0; robot < self.size(); ++robot) {
    found.push_back(self.robot(robot).pose(rows<Pose>(odometry)[robot]));
  }
  return array_of(found);
}

const Mapper& checked(const Fleet& self, std::size_t robot) {
  require(robot < self.size(), "there is no such robot");
  return self.robot(robot);
}

auto changed_tiles(Fleet& self, std::size_t robot) {
  require(robot < self.size(), "there is no such robot");
  const std::vector<Tile> tiles = self.robot(robot).changed_tiles();
  std::vector<std::int32_t> indices;
  std::vector<std::int8_t> cells;
  for (const Tile& it : tiles) {
    indices.insert(indices.end(), {it.index.column, it.index.row});
    cells.insert(cells.end(), it.cells.begin(), it.cells.end());
  }
  return std::pair{own(std::move(indices), {tiles.size(), 2}),
                   own(std::move(cells), {tiles.size(), Tile::kSide, Tile::kSide})};
}

std::pair<Output, double> optimised(const Matrix<3>& poses, const Table<std::int32_t>& pairs, const Matrix<3>& measured,
                                    const Table<double>& information, double huber, std::size_t fixed) {
  const std::size_t count = measured.shape(0);
  require(pairs.shape(0) == count && pairs.shape(1) == 2, "one pair of poses for each constraint");
  require(information.shape(0) == count && information.shape(1) == 9, "one matrix for each constraint");
  require(fixed >= 1, "at least one pose is fixed");
  std::vector<Pose> found = copy<Pose>(poses);
  std::vector<Constraint> constraints;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t from = pairs.data()[2 * i], to = pairs.data()[2 * i + 1];
    const auto known = [&](std::int32_t index) { return index >= 0 && static_cast<std::size_t>(index) < found.size(); };
    require(known(from) && known(to) && from != to, "a constraint is between two of the poses");
    Constraint it{static_cast<std::size_t>(from), static_cast<std::size_t>(to), rows<Pose>(measured)[i], {}, huber};
    std::copy_n(information.data() + 9 * i, 9, it.information.begin());
    constraints.push_back(it);
  }
  const double cost = optimise(found, constraints, fixed);
  return {array_of(found), cost};
}

}  // namespace

NB_MODULE(slam, module) {
  use_options();
  module.doc() = "Localisation and mapping of a fleet, in C++.";
  module.attr("TILE") = Tile::kSide;

  nb::class_<Fleet>(module, "Fleet")
      .def("__init__", &construct, nb::kw_only(), "placements"_a, "parameters"_a)
      .def(
          "begin", [](Fleet& self, const Matrix<3>& odometry) { self.begin(rows<Pose>(odometry)); }, "odometry"_a)
      .def("sense", &sense, "robots"_a, "ranges"_a, "odometry"_a, nb::kw_only(), "now"_a, "range"_a, "min_range"_a,
           "forward"_a, "leftward"_a)
      .def("poses", &poses, "odometry"_a, nb::rv_policy::automatic)
      .def(
          "scan_poses", [](const Fleet& self, std::size_t robot) { return array_of(checked(self, robot).poses()); },
          "robot"_a, nb::rv_policy::automatic)
      .def(
          "loops", [](const Fleet& self, std::size_t robot) { return checked(self, robot).loops(); }, "robot"_a)
      .def("changed_tiles", &changed_tiles, "robot"_a, nb::rv_policy::automatic);

  module.def("optimised", &optimised, "poses"_a, "pairs"_a, "measured"_a, "information"_a, nb::kw_only(),
             "huber"_a = 0.0, "fixed"_a = 1, nb::rv_policy::automatic);
  module.def("options", [] { return parameters(Parameters::description()); });
}
