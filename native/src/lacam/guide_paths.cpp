#include "lacam/guide_paths.hpp"

#include <algorithm>

namespace mrpbench::mapf::lacam {

GuidePaths::GuidePaths(std::span<const Path> paths) : steps_(paths.size()) {
  for (std::size_t robot = 0; robot < paths.size(); ++robot) {
    const Path& path = paths[robot];
    longest_ = std::max(longest_, arrival(path));
    for (std::size_t k = 2; k < path.size(); k += 2) steps_[robot].push_back({path[k - 2].element, path[k].element});
    std::ranges::stable_sort(steps_[robot], {}, &Step::from);
  }
}

std::int32_t GuidePaths::next(int robot, std::int32_t vertex) const {
  const auto after = std::ranges::upper_bound(steps_[robot], vertex, {}, &Step::from);
  return after != steps_[robot].begin() && (after - 1)->from == vertex ? (after - 1)->to : -1;
}

}  // namespace mrpbench::mapf::lacam
