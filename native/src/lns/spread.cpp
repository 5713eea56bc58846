#include "lns/spread.hpp"

#include <algorithm>
#include <numeric>

namespace mrpbench::mapf::lns {

namespace {

constexpr int kRounds = 2;    // in the first one the paths of the others are not known yet
constexpr Tick kDetour = 10;  // ticks by which a path may be longer than the shortest

bool is_in_conflict(const Schedule& schedule, int robot) {
  bool found = false;
  for (const Occupation& it : schedule.paths()[robot]) {
    schedule.traffic().conflicts_of(robot, it, [&](int) { found = true; });
    if (found) return true;
  }
  return false;
}

}  // namespace

void spread(Schedule& schedule) {
  std::vector<int> order(schedule.instance().size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int robot) { return -schedule.least(robot); });
  for (int round = 0; round < kRounds; ++round) {
    for (const int robot : order) {
      if (round > 0 && !is_in_conflict(schedule, robot)) continue;
      // A shortest path exists whatever the others do, so the search always finds one.
      schedule.plan({robot}, Others::soft, [&](int) { return schedule.least(robot) + kDetour; });
      schedule.accept({robot});
    }
  }
}

}  // namespace mrpbench::mapf::lns
