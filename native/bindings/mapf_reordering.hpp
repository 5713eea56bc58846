// Python bindings of re-ordering in execution.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "arrays.hpp"
#include "mapf_solvers.hpp"
#include "mrpbench_mapf/reordering/gses.hpp"
#include "mrpbench_mapf/reordering/open_orders.hpp"

namespace mrpbench::bindings {

using Arcs = nb::ndarray<const std::int32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

/// The earliest times of events under arcs that hold.
inline auto earliest(const Vector<std::int32_t>& first, const Vector<std::int32_t>& duration, const Arcs& arcs) {
  mapf::AlternativeGraph graph;
  graph.first.assign(first.data(), first.data() + first.size());
  graph.duration.assign(duration.data(), duration.data() + duration.size());
  graph.fixed = copy<mapf::Arc>(arcs);
  graph.check();
  auto times = earliest_times(graph.first, graph.duration, graph.fixed);
  require(times.size() == graph.duration.size(), "the arcs form a cycle");
  const std::size_t count = times.size();
  return own(std::move(times), {count});
}

inline mapf::AlternativeGraph alternative_graph(const Vector<std::int32_t>& first, const Vector<std::int32_t>& duration,
                                                const Arcs& fixed, const Arcs& planned, const Arcs& switched) {
  static_assert(sizeof(mapf::Arc) == 3 * sizeof(std::int32_t));
  require(planned.shape(0) == switched.shape(0), "as many switched arcs as planned ones");
  mapf::AlternativeGraph graph;
  graph.first.assign(first.data(), first.data() + first.size());
  graph.duration.assign(duration.data(), duration.data() + duration.size());
  graph.fixed = copy<mapf::Arc>(fixed);
  const auto one = rows<mapf::Arc>(planned), other = rows<mapf::Arc>(switched);
  for (std::size_t k = 0; k < one.size(); ++k) graph.alternatives.push_back({one[k], other[k]});
  return graph;
}

inline auto open_orders(const Vector<std::int32_t>& first, const Vector<std::int32_t>& duration, const Arcs& fixed,
                        const Arcs& planned, const Arcs& switched, const Vector<std::int32_t>& together,
                        const Vector<std::int64_t>& begin, std::int64_t limit) {
  const mapf::AlternativeGraph graph = alternative_graph(first, duration, fixed, planned, switched);
  auto groups = mapf::open_orders(graph, std::span(together.data(), together.size()),
                                  std::span(begin.data(), begin.size()), limit);
  const std::size_t count = groups.size();
  return own(std::move(groups), {count});
}

inline mapf::Reordering reorder(const Vector<std::int32_t>& first, const Vector<std::int32_t>& duration,
                                const Arcs& fixed, const Arcs& planned, const Arcs& switched, double wall_s,
                                std::int64_t memory_bytes, std::optional<std::int64_t> work_limit) {
  const mapf::AlternativeGraph graph = alternative_graph(first, duration, fixed, planned, switched);
  const nb::gil_scoped_release without_python;
  mapf::Limits limits(wall_s, memory_bytes);
  return solve_gses(graph, limits, work_limit.value_or(std::numeric_limits<std::int64_t>::max()));
}

inline void define_reordering(nb::module_& module) {
  using namespace nb::literals;
  using mapf::Reordering;
  nb::class_<Reordering>(module, "Reordering", "The best order of robots found.")
      .def_prop_ro("status", [](const Reordering& it) { return name_of(it.status); })
      .def_prop_ro(
          "switched",
          [](const Reordering& it) {
            std::vector<std::uint8_t> values(it.switched.begin(), it.switched.end());
            return own(std::move(values), {it.switched.size()});
          },
          nb::rv_policy::automatic)
      .def_ro("cost", &Reordering::cost)
      .def_ro("planned_cost", &Reordering::planned_cost)
      .def_ro("lower_bound", &Reordering::lower_bound)
      .def_ro("expansions", &Reordering::expansions)
      .def_ro("work", &Reordering::work)
      .def_ro("decisions", &Reordering::decisions);
  module.def("earliest", &earliest, "first"_a, "duration"_a, "arcs"_a);
  module.def("open_orders", &open_orders, nb::kw_only(), "first"_a, "duration"_a, "fixed"_a, "planned"_a, "switched"_a,
             "together"_a, "begin"_a, "limit"_a);
  module.def("reorder", &reorder, nb::kw_only(), "first"_a, "duration"_a, "fixed"_a, "planned"_a, "switched"_a,
             "wall_s"_a, "memory_bytes"_a, "work_limit"_a = nb::none());
}

}  // namespace mrpbench::bindings
