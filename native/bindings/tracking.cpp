// Python bindings of tracking and prediction: arrays in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <utility>

#include "arrays.hpp"
#include "mrpbench_tracking/fleet.hpp"
#include "options.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::tracking;

namespace {

using Output = nb::ndarray<nb::numpy, double>;

static_assert(sizeof(Segment) == 4 * sizeof(double) && sizeof(Pose) == 3 * sizeof(double));
static_assert(sizeof(Walker) == 4 * sizeof(double) && sizeof(Point) == 2 * sizeof(double));

void construct(Fleet* self, const Matrix<4>& walls, const Matrix<2>& mount, const Vector<double>& radius,
               const nb::dict& given, bool social_force, int threads) {
  require(radius.size() == mount.shape(0), "one radius for each robot");
  std::vector<Carrier> carriers;
  for (std::size_t i = 0; i < radius.size(); ++i) carriers.push_back({rows<Point>(mount)[i], radius.data()[i]});
  new (self) Fleet(copy<Segment>(walls), std::move(carriers), configured_by<Options>(given), social_force, threads);
}

Output see(Fleet& self, double now, const Vector<std::int32_t>& robots, const Matrix<3>& poses,
           const Table<double>& ranges) {
  require(ranges.shape(0) == robots.size() && poses.shape(0) == self.size(), "a scan for each robot, a pose for all");
  for (const std::int32_t robot : rows<std::int32_t>(robots)) {
    require(robot >= 0 && static_cast<std::size_t>(robot) < self.size(), "there is no such robot");
  }
  std::vector<double> left(ranges.data(), ranges.data() + ranges.size());
  {
    const nb::gil_scoped_release release;
    self.see(now, rows<std::int32_t>(robots), rows<Pose>(poses), left);
  }
  return own(std::move(left), {ranges.shape(0), ranges.shape(1)});
}

Output places_array(const Places& places, std::size_t count) {
  std::vector<double> values;
  values.reserve(2 * places.size());
  for (const Point& it : places) values.insert(values.end(), {it.x, it.y});
  return own(std::move(values), {places.size() / count, count, 2});
}

std::pair<nb::ndarray<nb::numpy, std::int32_t>, Output> predict(const Fleet& self, double now) {
  Predicted predicted = self.predict(now);
  const std::size_t size = predicted.robot.size();
  return {own(std::move(predicted.robot), {size}), places_array(predicted.places, predicted.count)};
}

Output tracks(const Fleet& self, std::size_t robot) {
  require(robot < self.size(), "there is no such robot");
  std::vector<double> values;
  for (const Track& it : self.tracks(robot)) {
    values.insert(values.end(), {it.place.x, it.place.y, it.velocity.x, it.velocity.y,
                                 static_cast<double>(it.detections), it.detected});
  }
  const std::size_t size = values.size() / 6;
  return own(std::move(values), {size, 6});
}

Output social_force(const Matrix<4>& objects, double radius, const Matrix<4>& walls, const Matrix<2>& robots,
                    const Vector<double>& robot_radius, double step, std::size_t count) {
  require(robot_radius.size() == robots.shape(0), "one radius for each robot");
  require(count > 0, "at least one place of each");
  return places_array(by_social_force(rows<Walker>(objects), radius, copy<Segment>(walls), rows<Point>(robots),
                                      rows<double>(robot_radius), step, count),
                      count);
}

}  // namespace

NB_MODULE(tracking, module) {
  use_options();
  module.doc() = "Moving objects in the scans of a fleet: tracks and predictions, in C++.";
  module.attr("STEP") = kStep;

  nb::class_<Fleet>(module, "Fleet")
      .def("__init__", &construct, nb::kw_only(), "walls"_a, "mount"_a, "radius"_a, "options"_a, "social_force"_a,
           "threads"_a)
      .def("see", &see, "now"_a, "robots"_a, "pose"_a, "ranges"_a, nb::rv_policy::automatic)
      .def("predict", &predict, "now"_a, nb::rv_policy::automatic)
      .def("tracks", &tracks, "robot"_a, nb::rv_policy::automatic);

  module.def("social_force", &social_force, "objects"_a, nb::kw_only(), "radius"_a, "walls"_a, "robots"_a,
             "robot_radius"_a, "step"_a, "count"_a, nb::rv_policy::automatic);
  module.def("options", [] { return parameters(Options::description()); });
}
