#include "scheduler.hpp"

#include <algorithm>
#include <cstdlib>
#include <queue>

namespace mrpbench::discrete {
namespace {

constexpr std::size_t kPairs = 40'000;
///< Above it only the tasks that are nearest by Manhattan distance are weighed exactly.
constexpr std::size_t kNearest = 24;
constexpr std::uint32_t kWay = 5;

}  // namespace

std::uint32_t Scheduler::rest(const Tasks& all, int task, int errand) {
  const int line = all.all()[task].line, first = problem_.first[line];
  if (rest_.empty()) rest_.assign(problem_.errands.size(), -1);
  const int count = all.errands(task);
  if (rest_[first] < 0) {
    std::uint32_t length = 0;
    rest_[first + count - 1] = 0;
    for (int i = count - 2; i >= 0; --i) {
      const int from = problem_.errands[first + i], to = problem_.errands[first + i + 1];
      length += tables_.clustered() ? tables_.estimate({from, 0}, to) : tables_.to(to).from(from);
      rest_[first + i] = length;
    }
  }
  return static_cast<std::uint32_t>(rest_[first + errand]);
}

std::vector<std::int32_t> Scheduler::choose(const Tasks& all, const std::vector<Pose>& pose,
                                            const std::vector<std::int32_t>& robots,
                                            const std::vector<std::int32_t>& tasks, std::size_t most,
                                            const std::vector<std::uint32_t>& later) {
  using Option = std::pair<std::uint32_t, std::int32_t>;
  std::vector<std::vector<Option>> options(robots.size());
  std::vector<std::uint32_t> rests;
  for (const int task : tasks) rests.push_back(rest(all, task, 0));
  const bool screened = robots.size() * tasks.size() > kPairs && tasks.size() > kNearest;
  const int width = problem_.grid.width();
  std::vector<std::int32_t> rows, columns;
  for (const int task : tasks) {
    const int place = problem_.grid.place(all.cell(task, 0));
    rows.push_back(place / width);
    columns.push_back(place % width);
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    auto& own = options[i];
    const Pose from = pose[robots[i]];
    const std::uint32_t wait = later.empty() ? 0 : later[robots[i]];
    const int row = problem_.grid.place(from.cell) / width, column = problem_.grid.place(from.cell) % width;
    own.reserve(tasks.size());
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      const std::uint32_t way = screened ? std::abs(rows[k] - row) + std::abs(columns[k] - column)
                                         : tables_.estimate(from, all.cell(tasks[k], 0));
      own.push_back({kWay * (way + wait) + rests[k], static_cast<std::int32_t>(k)});
    }
    if (screened) {
      std::nth_element(own.begin(), own.begin() + kNearest, own.end());
      own.resize(kNearest);
      own.shrink_to_fit();
      for (auto& [cost, k] : own) cost = kWay * (tables_.estimate(from, all.cell(tasks[k], 0)) + wait) + rests[k];
    }
    std::sort(own.begin(), own.end(), std::greater<>());
  }
  std::priority_queue<std::pair<Option, std::size_t>, std::vector<std::pair<Option, std::size_t>>, std::greater<>> heap;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!options[i].empty()) heap.push({options[i].back(), i});
  }
  std::vector<std::int32_t> found(robots.size(), -1);
  std::vector<std::uint8_t> taken(tasks.size(), 0);
  while (!heap.empty() && most > 0) {
    const auto [best, i] = heap.top();
    heap.pop();
    if (taken[best.second]) {
      options[i].pop_back();
      if (!options[i].empty()) heap.push({options[i].back(), i});
      continue;
    }
    --most;
    taken[best.second] = 1;
    found[i] = tasks[best.second];
  }
  return found;
}

}  // namespace mrpbench::discrete
