#include "mrpbench_mapf/single_agent/path_lengths.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace mrpbench::mapf {

std::vector<double> path_lengths(int vertex_count, std::span<const WeightedEdge> edges, std::span<const int> sources,
                                 std::span<const int> targets) {
  std::vector<std::size_t> first(vertex_count + 1);
  for (const WeightedEdge& edge : edges) ++first[edge.tail + 1];
  for (int v = 0; v < vertex_count; ++v) first[v + 1] += first[v];
  std::vector<WeightedEdge> leaving(edges.size());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (const WeightedEdge& edge : edges) leaving[next[edge.tail]++] = edge;

  std::vector<char> wanted(vertex_count);
  for (const int target : targets) wanted[target] = 1;
  const auto different = std::count(wanted.begin(), wanted.end(), 1);

  std::vector<double> found;
  found.reserve(sources.size() * targets.size());
  std::vector<double> length;
  for (const int source : sources) {
    length.assign(vertex_count, std::numeric_limits<double>::infinity());
    length[source] = 0.0;
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    open.emplace(0.0, source);
    for (auto missing = different; missing > 0 && !open.empty();) {
      const auto [so_far, vertex] = open.top();
      open.pop();
      if (so_far > length[vertex]) continue;
      missing -= wanted[vertex];
      for (std::size_t e = first[vertex]; e < first[vertex + 1]; ++e) {
        const double through = so_far + leaving[e].length;
        if (through < length[leaving[e].head]) open.emplace(length[leaving[e].head] = through, leaving[e].head);
      }
    }
    for (const int target : targets) found.push_back(length[target]);
  }
  return found;
}

}  // namespace mrpbench::mapf
