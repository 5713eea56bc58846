#include "mrpbench_mapf/single_agent/resource_users.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace mrpbench::mapf {

ResourceUsers::ResourceUsers(const Instance& instance) : instance_(instance), users_(instance.resources().size()) {}

void ResourceUsers::add(int robot, std::span<const Occupation> path) {
  for (const auto& [resource, halves] : uses(instance_, path)) users_[resource].push_back({robot, halves});
}

void ResourceUsers::remove(int robot, std::span<const Occupation> path) {
  for (const auto& [resource, halves] : uses(instance_, path)) {
    std::erase_if(users_[resource], [&](const User& it) { return it.robot == robot && it.halves == halves; });
  }
}

void ResourceUsers::clear() {
  for (std::vector<User>& it : users_) it.clear();
}

void ResourceUsers::full(int robot, int resource, std::vector<Range>& halves) const {
  const Resource& it = instance_.resources()[resource];
  const auto add = [&](Half first, Half last) {  // before the first, its own setup would reach into it
    const std::int64_t since = first - std::int64_t{2} * it.setup;
    halves.push_back({static_cast<Half>(std::max<std::int64_t>(since, 0)), last});
  };
  if (it.capacity == 1) {
    for (const User& use : users_[resource]) {
      if (use.robot != robot) add(use.halves.first, use.halves.last);
    }
    return;
  }
  std::vector<User> others;
  std::ranges::copy_if(users_[resource], std::back_inserter(others), [&](const User& it) { return it.robot != robot; });
  std::ranges::sort(others, [](const User& a, const User& b) {
    return a.robot != b.robot ? a.robot < b.robot : a.halves.first < b.halves.first;
  });
  std::vector<std::pair<Half, int>> changes;  // of the number of robots, at half-ticks
  for (std::size_t i = 0; i < others.size();) {
    Range whole = others[i].halves;
    const std::int32_t who = others[i].robot;
    for (++i; i < others.size() && others[i].robot == who && others[i].halves.first <= whole.last + 1; ++i) {
      whole.last = std::max(whole.last, others[i].halves.last);
    }
    changes.push_back({whole.first, 1});
    changes.push_back({whole.last + 1, -1});
  }
  std::ranges::sort(changes);
  int count = 0;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    count += changes[i].second;
    if (count >= it.capacity && changes[i + 1].first > changes[i].first)
      add(changes[i].first, changes[i + 1].first - 1);
  }
}

void ResourceUsers::full_departures(int robot, int resource, Tick duration, std::vector<Range>& departures) const {
  std::vector<Range> halves;
  full(robot, resource, halves);
  for (const Range& it : halves) {
    const Range hit = departures_into(it, duration);
    if (hit.first <= hit.last) departures.push_back(hit);
  }
}

std::vector<int> ResourceUsers::too_many_with(int robot, const Use& use) const {
  std::vector<User> others;
  beside(robot, use, [&](int other, Range halves) { others.push_back({other, halves}); });
  std::vector<Half> times{use.halves.first};  // at which the number of robots may have risen
  for (const User& it : others) times.push_back(std::max(it.halves.first, use.halves.first));
  std::vector<int> found, present;
  for (const Half time : times) {
    present.clear();
    for (const User& it : others) {
      if (it.halves.first > time || it.halves.last < time) continue;
      if (std::ranges::find(present, it.robot) == present.end()) present.push_back(it.robot);
    }
    const bool too_many = static_cast<int>(present.size()) >= instance_.resources()[use.resource].capacity;
    if (too_many) found.insert(found.end(), present.begin(), present.end());
  }
  return found;
}

}  // namespace mrpbench::mapf
