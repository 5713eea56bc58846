// Python bindings: arrays in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "mapf_instance.hpp"
#include "mapf_reordering.hpp"
#include "mrpbench_mapf/algorithms/algorithms.hpp"
#include "mrpbench_mapf/single_agent/path_lengths.hpp"
#include "options.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using namespace mrpbench::mapf;
using namespace mrpbench::bindings;

namespace {

template <class T>
using Output = nb::ndarray<nb::numpy, const T, nb::ndim<1>>;
using Points = nb::ndarray<nb::numpy, const double, nb::shape<-1, 3>>;

/// A read-only view; as the value of a property it keeps its owner alive.
template <class T>
Output<T> view(const std::vector<T>& values) {
  return Output<T>(values.data(), {values.size()});
}

/// A result as Python sees it.
struct Answer {
  Result result;
  std::vector<std::int64_t> first{0}, enter, leave;
  std::vector<std::int32_t> edge;

  Answer(const Instance& instance, Result solved) : result(std::move(solved)) {
    for (std::size_t robot = 0; robot < result.paths.size(); ++robot) {
      for (const Segment& segment : segments(instance, static_cast<int>(robot), result.paths[robot])) {
        edge.push_back(segment.edge);
        enter.push_back(segment.enter);
        leave.push_back(segment.leave);
      }
      first.push_back(static_cast<std::int64_t>(edge.size()));
    }
  }

  const char* status() const { return name_of(result.status); }

  nb::dict statistics() const {
    const Statistics& it = result.statistics;
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

Points history(const Answer& it) {
  static_assert(sizeof(Progress) == 3 * sizeof(double));
  const auto* first = reinterpret_cast<const double*>(it.result.history.data());  // null where it is empty
  return Points(first, {it.result.history.size(), 3});
}

Answer solve(const Instance& instance, const std::string& name, const nb::dict& options, double wall_s,
             std::int64_t memory_bytes) {
  const Algorithm& chosen = algorithm(name);
  Algorithm::Solver solver;
  try {
    solver = chosen.configure(from_python(options, chosen.options));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + ": " + error.what());
  }
  nb::gil_scoped_release without_python;
  Limits limits(wall_s, memory_bytes);
  return {instance, solver(instance, limits)};
}

nb::ndarray<nb::numpy, double> lengths_of_paths(int vertex_count, const Table<std::int32_t>& ends,
                                                const Vector<double>& length, const Vector<std::int32_t>& sources,
                                                const Vector<std::int32_t>& targets) {
  require(ends.shape(1) == 2 && length.size() == ends.shape(0), "edges have two ends and a length each");
  const auto known = [&](int vertex) { return vertex >= 0 && vertex < vertex_count; };
  std::vector<WeightedEdge> edges;
  for (std::size_t e = 0; e < length.size(); ++e) {
    edges.push_back({ends.data()[2 * e], ends.data()[2 * e + 1], length.data()[e]});
    require(known(edges[e].tail) && known(edges[e].head), "an edge ends at a vertex that does not exist");
    require(edges[e].length >= 0.0, "lengths are not below 0");
  }
  const auto from = copy<int>(sources), to = copy<int>(targets);
  for (const auto& named : {from, to}) require(std::ranges::all_of(named, known), "a vertex does not exist");
  return own<double>(path_lengths(vertex_count, edges, from, to), {from.size(), to.size()});
}

}  // namespace

NB_MODULE(mapf, module) {
  use_options();
  module.doc() = "Multi-agent path finding in C++. Plain arrays in, plain arrays out.";

  nb::class_<Instance>(module, "Instance", "Robots on a roadmap. Raises ValueError for data that make no sense.")
      .def("__init__", &construct, nb::kw_only(), "roadmap"_a, "robots"_a, "exclusions"_a, "resources"_a,
           "following_forbidden"_a, "disappear_at_goal"_a);

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

  nb::class_<Algorithm>(module, "Algorithm", "An algorithm and its options.")
      .def_ro("name", &Algorithm::name)
      .def_ro("help", &Algorithm::help, "One sentence.")
      .def_ro("options", &Algorithm::options);

  module.def("algorithms", &algorithms, "All algorithms, in alphabetical order.");
  module.def("describe", &algorithm, "name"_a, nb::rv_policy::reference,
             "The algorithm of this name. Raises ValueError if there is none.");
  module.def("solve", &solve, "instance"_a, "algorithm"_a, "options"_a, nb::kw_only(), "wall_s"_a, "memory_bytes"_a,
             "Solve an instance. Raises ValueError for an option that does not exist or that cannot have its value.");
  module.def("path_lengths", &lengths_of_paths, "vertex_count"_a, "edges"_a, "length"_a, "sources"_a, "targets"_a,
             "f8[sources,targets], infinite where there is no path; edges i4[E,2], length f8[E] not below 0.");

  define_reordering(module);
}
