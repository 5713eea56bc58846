// The edge-weighted minimum vertex cover of Li et al., IJCAI 2019 (see dependencies.hpp), by branch and bound for each
// connected part of the graph.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

struct WeightedEdge {
  std::int32_t one, other;  // vertices from 0
  std::int32_t weight;      // at least 1
};

/// Least sum of x[v] >= 0 over the vertices such that x[one] + x[other] >= weight for every edge. Integers. Where a
/// part takes too long, a lower bound (the weight of a matching) stands for it.
Cost minimum_cover(int vertices, std::span<const WeightedEdge> edges, Limits& limits);

}  // namespace mrpbench::mapf
