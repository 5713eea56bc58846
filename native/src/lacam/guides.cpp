#include "lacam/guides.hpp"

#include <algorithm>
#include <numeric>

namespace mrpbench::mapf::lacam {

namespace {

bool is_in_conflict(const lns::Schedule& schedule, int robot) {
  bool found = false;
  for (const Occupation& it : schedule.paths()[robot]) {
    schedule.traffic().conflicts_of(robot, it, [&](int) { found = true; });
    if (found) return true;
  }
  return false;
}

}  // namespace

Guides::Guides(lns::Schedule& schedule) : steps_(schedule.instance().size()) {
  std::vector<int> order(steps_.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int robot) { return -schedule.least(robot); });
  for (int round = 0; round < kRounds; ++round) {
    for (const int robot : order) {
      if (round > 0 && !is_in_conflict(schedule, robot)) continue;
      // A shortest way exists whatever the others do: this always finds one.
      schedule.plan({robot}, lns::Others::soft, [&](int) { return schedule.least(robot) + kDetour; });
      schedule.accept({robot});
    }
  }
  for (const int robot : order) {
    const Path& path = schedule.paths()[robot];
    longest_ = std::max(longest_, arrival(path));
    for (std::size_t k = 2; k < path.size(); k += 2) steps_[robot].push_back({path[k - 2].element, path[k].element});
    std::ranges::stable_sort(steps_[robot], {}, &Step::from);
  }
}

std::int32_t Guides::next(int robot, std::int32_t vertex) const {
  const auto after = std::ranges::upper_bound(steps_[robot], vertex, {}, &Step::from);
  return after != steps_[robot].begin() && (after - 1)->from == vertex ? (after - 1)->to : -1;
}

}  // namespace mrpbench::mapf::lacam
