// Dial's algorithm (1969) backwards from the goal over poses: the buckets hold poses by cost modulo the largest cost.
#include "mrpbench_discrete/distance_tables.hpp"

#include <algorithm>
#include <stdexcept>

namespace mrpbench::discrete {

DistanceTables::DistanceTables(const Grid& grid, std::size_t bytes)
    : grid_(grid), room_(std::max<std::size_t>(1, bytes / (sizeof(std::uint32_t) * grid.size()))) {
  of_goal_.assign(grid.size(), nullptr);
}

const DistanceTable& DistanceTables::to(int goal) {
  if (Kept* const kept = of_goal_[goal]) {
    if (tables_.size() > room_ / 2) order_.splice(order_.begin(), order_, kept->used);
    return kept->table;
  }
  order_.push_front(goal);
  Kept& kept = tables_[goal] = {computed(goal), order_.begin()};
  of_goal_[goal] = &kept;
  return kept.table;
}

void DistanceTables::set_costs(Costs costs) {
  if (costs.turn > Costs::most_turn) throw std::invalid_argument("a turn should cost at most 3");
  costs_ = std::move(costs);
  ++version_;
  outdated_.assign(order_.begin(), order_.end());
}

bool DistanceTables::refresh(std::size_t cells) {
  const std::size_t size = grid_.size();
  credit_ += cells;
  while (!outdated_.empty() && credit_ >= size) {
    Kept* const kept = of_goal_[outdated_.back()];
    if (kept && kept->table.version_ != version_) {
      kept->table = computed(outdated_.back());
      credit_ -= size;
    }
    outdated_.pop_back();
  }
  if (outdated_.empty()) credit_ = 0;
  return outdated_.empty();
}

void DistanceTables::forget() {
  while (tables_.size() > room_) {
    of_goal_[order_.back()] = nullptr;
    tables_.erase(order_.back());
    order_.pop_back();
  }
}

DistanceTable DistanceTables::computed(int goal) {
  const int cells = grid_.size();
  const auto& forward = costs_.forward;
  std::uint32_t most = costs_.turn;
  if (forward.empty()) most = std::max(most, 1u);
  for (const std::uint8_t cost : forward) most = std::max<std::uint32_t>(most, cost);
  buckets_.resize(most + 1);
  cost_.assign(4 * static_cast<std::size_t>(cells), DistanceTable::unreachable);
  std::size_t waiting = 0;
  const auto reach = [&](int state, std::uint32_t cost) {
    if (cost >= cost_[state]) return;
    cost_[state] = cost;
    buckets_[cost % buckets_.size()].push_back(state);
    ++waiting;
  };
  for (int heading = 0; heading < 4; ++heading) reach(4 * goal + heading, 0);
  for (std::uint32_t now = 0; waiting > 0; ++now) {
    auto& bucket = buckets_[now % buckets_.size()];
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const int state = bucket[i];
      if (cost_[state] != now) continue;
      const int cell = state >> 2, heading = state & 3;
      reach((cell << 2) | ((heading + 1) & 3), now + costs_.turn);
      reach((cell << 2) | ((heading + 3) & 3), now + costs_.turn);
      const int behind = grid_.ahead(cell, (heading + 2) & 3);
      if (behind >= 0) {
        const int before = (behind << 2) | heading;
        reach(before, now + (forward.empty() ? 1 : forward[before]));
      }
    }
    waiting -= bucket.size();
    bucket.clear();
  }
  DistanceTable table;
  table.version_ = version_;
  table.packed_.resize(cells);
  for (int cell = 0; cell < cells; ++cell) {
    const std::uint32_t* const cost = &cost_[4 * static_cast<std::size_t>(cell)];
    const std::uint32_t best = std::min(*std::min_element(cost, cost + 4), DistanceTable::unreachable);
    std::uint32_t word = best << 12;
    for (int heading = 0; heading < 4; ++heading) word |= std::min(cost[heading] - best, 7u) << (3 * heading);
    table.packed_[cell] = word;
  }
  return table;
}

}  // namespace mrpbench::discrete
