#include <random>

#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/cbs/tree/vertex_cover.hpp"

using namespace mrpbench::mapf;

namespace {

/// Every assignment of 0..3 to the vertices.
Cost by_enumeration(int vertices, const std::vector<WeightedEdge>& edges) {
  Cost best = 1000;
  for (int code = 0; code < 1 << 2 * vertices; ++code) {
    const auto value = [&](int vertex) { return code >> 2 * vertex & 3; };
    Cost sum = 0;
    for (int vertex = 0; vertex < vertices; ++vertex) sum += value(vertex);
    bool covers = true;
    for (const WeightedEdge& edge : edges) covers &= value(edge.one) + value(edge.other) >= edge.weight;
    if (covers) best = std::min(best, sum);
  }
  return best;
}

}  // namespace

TEST("covers have the least weight") {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    const int vertices = 2 + static_cast<int>(random() % 5);
    std::vector<WeightedEdge> edges;
    for (int one = 0; one < vertices; ++one) {
      for (int other = 0; other < one; ++other) {
        if (random() % 2 == 0) edges.push_back({one, other, 1 + static_cast<int>(random() % 3)});
      }
    }
    Limits limits = unlimited();
    CHECK(minimum_cover(vertices, edges, limits) == by_enumeration(vertices, edges));
  }
}

TEST("a large dense part has a lower bound") {
  std::vector<WeightedEdge> edges;
  for (int one = 0; one < 60; ++one) {
    for (int other = 0; other < one; ++other) edges.push_back({one, other, 1 + (one * other) % 3});
  }
  Limits limits = unlimited();
  const Cost cover = minimum_cover(60, edges, limits);
  CHECK(cover >= 30);  // a perfect matching of edges of weight 1
  CHECK(cover <= 3 * 59);
}
