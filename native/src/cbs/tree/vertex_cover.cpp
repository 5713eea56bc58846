#include "mrpbench_mapf/cbs/tree/vertex_cover.hpp"

#include <algorithm>
#include <limits>

namespace mrpbench::mapf {

namespace {

constexpr int kPatience = 20'000;  // steps for one part

class Cover {
 public:
  Cover(int vertices, std::span<const WeightedEdge> edges, Limits& limits)
      : limits_(limits), around_(vertices), value_(vertices, kOpen), seen_(vertices, false) {
    for (const auto& [one, other, weight] : edges) {
      around_[one].push_back({other, weight});
      around_[other].push_back({one, weight});
    }
  }

  Cost solve() {
    Cost sum = 0;
    for (std::size_t vertex = 0; vertex < around_.size(); ++vertex) {
      if (!seen_[vertex] && !around_[vertex].empty()) sum += solve_part(static_cast<int>(vertex));
    }
    return sum;
  }

 private:
  struct Neighbour {
    std::int32_t vertex;
    std::int32_t weight;
  };
  static constexpr std::int32_t kOpen = -1;

  Cost solve_part(int start) {
    part_.assign(1, start);
    seen_[start] = true;
    for (std::size_t k = 0; k < part_.size(); ++k) {
      for (const Neighbour& it : around_[part_[k]]) {
        if (seen_[it.vertex]) continue;
        seen_[it.vertex] = true;
        part_.push_back(it.vertex);
      }
    }
    if (part_.size() == 2) return around_[start][0].weight;
    // Vertices that bind many others first.
    std::ranges::stable_sort(part_, std::greater{}, [&](int v) { return around_[v].size(); });
    best_ = std::numeric_limits<Cost>::max();
    steps_ = 0;
    const Cost bound = matching(0);
    branch(0, 0);
    return steps_ > kPatience ? bound : best_;
  }

  /// Least that the vertices from `depth` on can add: edges between them that share no vertex.
  Cost matching(std::size_t depth) {
    taken_.assign(around_.size(), false);
    Cost sum = 0;
    for (std::size_t k = depth; k < part_.size(); ++k) {
      const int vertex = part_[k];
      if (taken_[vertex]) continue;
      const Neighbour* heaviest = nullptr;
      for (const Neighbour& it : around_[vertex]) {
        if (value_[it.vertex] != kOpen || taken_[it.vertex]) continue;
        if (heaviest == nullptr || it.weight > heaviest->weight) heaviest = &it;
      }
      if (heaviest == nullptr) continue;
      sum += heaviest->weight;
      taken_[vertex] = taken_[heaviest->vertex] = true;
    }
    return sum;
  }

  void branch(std::size_t depth, Cost sum) {
    limits_.check();
    if (++steps_ > kPatience) return;
    if (depth == part_.size()) {
      best_ = std::min(best_, sum);
      return;
    }
    if (sum + matching(depth) >= best_) return;
    const int vertex = part_[depth];
    std::int32_t least = 0, most = 0;
    for (const Neighbour& it : around_[vertex]) {
      if (value_[it.vertex] == kOpen) {
        most = std::max(most, it.weight);
      } else {
        least = std::max(least, it.weight - value_[it.vertex]);
      }
    }
    most = std::max(least, most);
    for (std::int32_t value = most; value >= least; --value) {
      value_[vertex] = value;
      branch(depth + 1, sum + value);
    }
    value_[vertex] = kOpen;
  }

  Limits& limits_;
  std::vector<std::vector<Neighbour>> around_;
  std::vector<std::int32_t> value_;
  std::vector<char> seen_, taken_;
  std::vector<int> part_;
  Cost best_ = 0;
  int steps_ = 0;
};

}  // namespace

Cost minimum_cover(int vertices, std::span<const WeightedEdge> edges, Limits& limits) {
  return Cover(vertices, edges, limits).solve();
}

}  // namespace mrpbench::mapf
