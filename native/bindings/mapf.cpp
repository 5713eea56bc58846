// Python bindings: arrays in, arrays out. Nothing here decides anything.
#include <algorithm>

#include "mapf_reordering.hpp"
#include "mapf_solvers.hpp"
#include "mrpbench_mapf/assignment/hungarian.hpp"
#include "mrpbench_mapf/single_agent/path_lengths.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using namespace mrpbench::mapf;
using namespace mrpbench::bindings;

namespace {

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

/// The rows of a matrix of costs.
std::vector<const double*> rows_of(const Table<double>& cost) {
  const std::size_t rows = cost.shape(0), columns = cost.shape(1);
  require(rows <= columns, "there are more rows than columns");
  std::vector<const double*> row;
  for (std::size_t i = 0; i < rows; ++i) row.push_back(cost.data() + i * columns);
  const auto sound = [](double entry) { return entry > -std::numeric_limits<double>::infinity(); };
  require(std::all_of(cost.data(), cost.data() + cost.size(), sound), "costs are numbers, or infinite if forbidden");
  return row;
}

Limits unlimited() {
  return {std::numeric_limits<double>::infinity(), std::numeric_limits<std::int64_t>::max()};
}

std::optional<nb::ndarray<nb::numpy, std::int32_t>> cheapest_assignment(const Table<double>& cost) {
  const auto rows = rows_of(cost);
  Limits limits = unlimited();
  BasicAssignment<double> found;
  if (!BasicHungarian<double>(limits).solve(rows, static_cast<int>(cost.shape(1)), found)) return std::nullopt;
  return own(std::move(found.column_of), {rows.size()});
}

std::optional<double> bottleneck(const Table<double>& cost) {
  const auto rows = rows_of(cost);
  Limits limits = unlimited();
  double greatest = 0;
  if (!BasicHungarian<double>(limits).find_bottleneck(rows, static_cast<int>(cost.shape(1)), greatest))
    return std::nullopt;
  return greatest;
}

}  // namespace

NB_MODULE(mapf, module) {
  use_options();
  module.doc() = "Multi-agent path finding in C++. Plain arrays in, plain arrays out.";
  bind_solvers(module, algorithms());
  module.def("path_lengths", &lengths_of_paths, "vertex_count"_a, "edges"_a, "length"_a, "sources"_a, "targets"_a,
             "f8[sources,targets], infinite where there is no path; edges i4[E,2], length f8[E] not below 0.");
  module.def("cheapest_assignment", &cheapest_assignment, "cost"_a,
             "i4[n]: the column of each row, all different, with the least sum of costs; None if there is none.");
  module.def("bottleneck", &bottleneck, "cost"_a,
             "The least cost such that all rows can have different columns that cost no more; None if there is none.");

  define_reordering(module);
}
