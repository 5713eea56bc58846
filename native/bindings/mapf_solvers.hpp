// Algorithms as functions of a Python module. `mrpbench_native.mapf` is such a module, and so is that of every planner
// that is built against this library: the class `NativePlanner` of `mrpbench_planners_mapf` calls both in the same way.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mapf_instance.hpp"
#include "mrpbench_mapf/algorithms/algorithms.hpp"
#include "options.hpp"

namespace mrpbench::bindings {

template <class T>
using Output = nb::ndarray<nb::numpy, const T, nb::ndim<1>>;
using Points = nb::ndarray<nb::numpy, const double, nb::shape<-1, 3>>;

/// A read-only view; as the value of a property it keeps its owner alive.
template <class T>
Output<T> view(const std::vector<T>& values) {
  return Output<T>(values.data(), {values.size()});
}

inline const char* name_of(mapf::Status status) {
  switch (status) {
    case mapf::Status::solved:
      return "solved";
    case mapf::Status::timeout:
      return "timeout";
    case mapf::Status::out_of_memory:
      return "out_of_memory";
    case mapf::Status::unsolvable:
      return "unsolvable";
    case mapf::Status::gave_up:
      break;
  }
  return "gave_up";
}

/// A result as Python sees it.
struct Answer {
  mapf::Result result;
  std::vector<std::int64_t> first{0}, enter, leave;
  std::vector<std::int32_t> edge;

  Answer(const mapf::Instance& instance, mapf::Result solved) : result(std::move(solved)) {
    for (std::size_t robot = 0; robot < result.paths.size(); ++robot) {
      for (const mapf::Segment& segment : segments(instance, static_cast<int>(robot), result.paths[robot])) {
        edge.push_back(segment.edge);
        enter.push_back(segment.enter);
        leave.push_back(segment.leave);
      }
      result.paths[robot] = {};  // which takes several times as much
      first.push_back(static_cast<std::int64_t>(edge.size()));
    }
  }

  const char* status() const { return name_of(result.status); }

  nb::dict statistics() const {
    const mapf::Statistics& it = result.statistics;
    nb::dict values;
    values["expansions"] = it.expansions;
    values["generated"] = it.generated;
    values["low_level_expansions"] = it.low_level_expansions;
    values["low_level_generated"] = it.low_level_generated;
    values["bypasses"] = it.bypasses;
    values["pair_expansions"] = it.pair_expansions;
    values["memory_bytes"] = it.memory_bytes;
    values["assignments"] = it.assignments;
    values["restarts"] = it.restarts;
    values["failed_robot"] = it.failed_robot;
    return values;
  }
};

inline Points history(const Answer& it) {
  static_assert(sizeof(mapf::Progress) == 3 * sizeof(double));
  const auto* first = reinterpret_cast<const double*>(it.result.history.data());  // null where it is empty
  return Points(first, {it.result.history.size(), 3});
}

inline Answer solve(const mapf::Instance& instance, const mapf::Algorithm& algorithm, const nb::dict& options,
                    double wall_s, std::int64_t memory_bytes) {
  mapf::Algorithm::Solver solver;
  try {
    solver = algorithm.configure(from_python(options, algorithm.options));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(algorithm.name + ": " + error.what());
  }
  nb::gil_scoped_release without_python;
  mapf::Limits limits(wall_s, memory_bytes);
  return {instance, solver(instance, limits)};
}

/// Give a module the classes `Instance`, `Answer` and `Algorithm` and functions that list and run `all`, which must
/// outlive the module. The class of options must exist: see `bind_options` and `use_options`.
inline void bind_solvers(nb::module_& module, const std::vector<mapf::Algorithm>& all) {
  using namespace nb::literals;
  nb::class_<KnownRoadmap>(module, "Roadmap",
                           "A roadmap for several instances; solvers go on with the distances that they found on it.")
      .def(nb::init<const nb::dict&>(), "arrays"_a);

  nb::class_<mapf::Instance>(module, "Instance", "Robots on a roadmap. Raises ValueError for data that make no sense.")
      .def("__init__", &construct, nb::kw_only(), "roadmap"_a, "robots"_a, "exclusions"_a, "resources"_a,
           "following_forbidden"_a, "disappear_at_goal"_a, "k"_a = 0, "horizon"_a = nb::none())
      .def("__init__", &construct_on, nb::kw_only(), "roadmap"_a, "robots"_a, "exclusions"_a, "resources"_a,
           "following_forbidden"_a, "disappear_at_goal"_a, "k"_a = 0, "horizon"_a = nb::none());

  nb::class_<Answer>(module, "Answer", "How a solver ended. The segments of robot r are [first[r], first[r + 1]).")
      .def_prop_ro("status", &Answer::status, "solved, timeout, out_of_memory, unsolvable or gave_up.")
      .def_prop_ro(
          "lower_bound", [](const Answer& it) { return it.result.lower_bound; },
          "Proved lower bound on the sum of arrival times in ticks, NaN if none.")
      .def_prop_ro("statistics", &Answer::statistics, "Counters; failed_robot is -1 where no robot is to blame.")
      .def_prop_ro(
          "clock_bound", [](const Answer& it) { return it.result.clock_bound; },
          "The clock ended the search for a better plan.")
      .def_prop_ro("history", &history, "f8[...,3]: seconds, cost of the best plan until then, lower bound.")
      .def_prop_ro(
          "first", [](const Answer& it) { return view(it.first); }, "i8[n+1], or [0] without a plan.")
      .def_prop_ro(
          "edge", [](const Answer& it) { return view(it.edge); }, "i4[...], -1 = wait.")
      .def_prop_ro(
          "enter", [](const Answer& it) { return view(it.enter); }, "i8[...] ticks.")
      .def_prop_ro("leave", [](const Answer& it) { return view(it.leave); }, "i8[...] ticks.");

  nb::class_<mapf::Algorithm>(module, "Algorithm", "An algorithm and its options.")
      .def_ro("name", &mapf::Algorithm::name)
      .def_ro("help", &mapf::Algorithm::help, "One sentence.")
      .def_ro("options", &mapf::Algorithm::options);

  module.def("algorithms", [&all] { return all; }, "All algorithms, in alphabetical order.");
  module.def(
      "describe", [&all](const std::string& name) -> const mapf::Algorithm& { return find(all, name); }, "name"_a,
      nb::rv_policy::reference, "The algorithm of this name. Raises ValueError if there is none.");
  module.def(
      "solve",
      [&all](const mapf::Instance& instance, const std::string& algorithm, const nb::dict& options, double wall_s,
             std::int64_t memory_bytes) {
        return solve(instance, find(all, algorithm), options, wall_s, memory_bytes);
      },
      "instance"_a, "algorithm"_a, "options"_a, nb::kw_only(), "wall_s"_a, "memory_bytes"_a,
      "Solve an instance. Raises ValueError for an option that does not exist or that cannot have its value.");
}

}  // namespace mrpbench::bindings
