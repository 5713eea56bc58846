#include "mrpbench_mapf/model/uses.hpp"

#include <algorithm>

namespace mrpbench::mapf {

std::vector<Use> uses(const Instance& instance, std::span<const Occupation> path) {
  std::vector<Use> result;
  if (instance.resources().empty()) return result;
  for (const Occupation& it : path) {
    for (const std::int32_t resource : instance.resources_of(it.element)) {
      const std::int64_t until = it.end + std::int64_t{2} * instance.resources()[resource].setup;
      const auto end = static_cast<Half>(std::min<std::int64_t>(until, kForeverHalf));
      const auto before = std::ranges::find(result.rbegin(), result.rend(), resource, &Use::resource);
      if (before != result.rend() && it.begin <= before->halves.last + 1) {
        before->halves.last = std::max(before->halves.last, end);
      } else {
        result.push_back({resource, {it.begin, end}});
      }
    }
  }
  return result;
}

std::vector<CapacityConflict> find_capacity_conflicts(const Instance& instance,
                                                      std::span<const std::span<const Occupation>> paths) {
  struct User {
    std::int32_t robot;
    Range halves;
  };
  std::vector<std::vector<User>> users(instance.resources().size());
  for (std::size_t robot = 0; robot < paths.size(); ++robot) {
    for (const Use& use : uses(instance, paths[robot])) {
      users[use.resource].push_back({static_cast<std::int32_t>(robot), use.halves});
    }
  }
  std::vector<CapacityConflict> found;
  for (std::size_t resource = 0; resource < users.size(); ++resource) {
    std::vector<User> present;
    std::ranges::sort(users[resource], {}, [](const User& it) { return std::pair(it.halves.first, it.robot); });
    for (const User& next : users[resource]) {
      std::erase_if(present, [&](const User& it) { return it.halves.last < next.halves.first; });
      present.push_back(next);
      if (present.size() <= static_cast<std::size_t>(instance.resources()[resource].capacity)) continue;
      for (std::size_t i = 0; i < present.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) found.push_back({present[j].robot, present[i].robot, next.halves.first});
      }
    }
  }
  return found;
}

}  // namespace mrpbench::mapf
