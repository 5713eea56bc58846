#include "landmarks.hpp"

#include <algorithm>
#include <cstdlib>

namespace mrpbench::discrete {

Landmarks::Landmarks(const Grid& grid, int cell) : grid_(grid), distance_(grid.size()) {
  std::vector<std::int32_t> nearest = distances(cell);
  for (int k = 0; k < kLandmarks; ++k) {
    const auto farthest = static_cast<int>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    const auto own = distances(farthest);
    for (int i = 0; i < grid.size(); ++i) {
      distance_[i][k] = own[i] < 0 ? kFar : static_cast<std::uint16_t>(std::min<std::int32_t>(own[i], kFar));
      nearest[i] = k == 0 ? own[i] : std::min(nearest[i], own[i]);
    }
  }
}

std::uint32_t Landmarks::bound(int a, int b) const {
  int found = grid_.manhattan(a, b);
  for (int k = 0; k < kLandmarks; ++k) {
    const int one = distance_[a][k], two = distance_[b][k];
    if (one < kFar && two < kFar) found = std::max(found, std::abs(one - two));
  }
  return static_cast<std::uint32_t>(found);
}

/// -1 = not reachable.
std::vector<std::int32_t> Landmarks::distances(int from) const {
  std::vector<std::int32_t> found(grid_.size(), -1), queue{from};
  found[from] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (int heading = 0; heading < 4; ++heading) {
      const int near = grid_.ahead(queue[i], heading);
      if (near < 0 || found[near] >= 0) continue;
      found[near] = found[queue[i]] + 1;
      queue.push_back(near);
    }
  }
  return found;
}

}  // namespace mrpbench::discrete
