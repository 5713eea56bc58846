// Lengths of shortest paths on a graph of weighted edges: E. W. Dijkstra, "A note on two problems in connexion with
// graphs", Numerische Mathematik 1, 1959.
#pragma once

#include <span>
#include <vector>

namespace mrpbench::mapf {

struct WeightedEdge {
  int tail, head;
  double length;  // not below 0
};

/// From each source to each target, row by row; infinite where there is no path.
std::vector<double> path_lengths(int vertex_count, std::span<const WeightedEdge> edges, std::span<const int> sources,
                                 std::span<const int> targets);

}  // namespace mrpbench::mapf
