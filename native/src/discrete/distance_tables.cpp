#include "mrpbench_discrete/distance_tables.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "landmarks.hpp"

namespace mrpbench::discrete {

DistanceTables::DistanceTables(const Grid& grid, std::size_t bytes, bool clustered)
    : grid_(grid), of_cell_(grid.size(), nullptr) {
  if (clustered) graph_ = std::make_unique<ClusterGraph>(grid);
  const std::size_t each = clustered ? ClusterTable::bytes(*graph_) : sizeof(std::uint32_t) * grid.size();
  room_ = std::max<std::size_t>(1, bytes / each);
}

DistanceTables::~DistanceTables() = default;

const DistanceTable& DistanceTables::to(int goal) {
  Goal* entry = of_cell_[goal];
  if (!entry) {
    entry = of_cell_[goal] = &goals_[goal];
    entry->version = version_;
  }
  if (entry->asked != version_ + 1) {
    entry->asked = version_ + 1;
    asked_.push_back(goal);
  }
  if (!entry->table)
    compute(goal, *entry);
  else if (order_.size() > room_ / 2)
    order_.splice(order_.begin(), order_, entry->used);
  return *entry->table;
}

std::uint32_t DistanceTables::estimate(const Pose& from, int goal) {
  if (!graph_) return to(goal).from(from);
  if (!landmarks_) landmarks_ = std::make_unique<Landmarks>(grid_, goal);
  return landmarks_->bound(from.cell, goal);
}

void DistanceTables::compute(int goal, Goal& entry) {
  while (order_.size() >= room_) drop(*of_cell_[order_.back()]);
  entry.table = std::make_unique<DistanceTable>();
  if (graph_)
    entry.table->clusters_ = std::make_unique<ClusterTable>(*graph_, goal, costs_.turn);
  else
    entry.table->whole_ = computed(goal, entry.version == version_ ? costs_ : former_costs_);
  order_.push_front(goal);
  entry.used = order_.begin();
}

void DistanceTables::drop(Goal& entry) {
  if (!entry.table) return;
  entry.table.reset();
  order_.erase(entry.used);
}

void DistanceTables::set_costs(Costs costs) {
  if (costs.turn > Costs::most_turn) throw std::invalid_argument("a turn should cost at most 3");
  if (graph_) throw std::invalid_argument("clustered tables have no costs of moves");
  // Goals whose costs would be older than the former ones, and those that nobody asks for any more.
  for (auto it = goals_.begin(); it != goals_.end();) {
    if (it->second.version == version_ && it->second.asked == version_ + 1) {
      ++it;
      continue;
    }
    drop(it->second);
    of_cell_[it->first] = nullptr;
    it = goals_.erase(it);
  }
  former_costs_ = std::exchange(costs_, std::move(costs));
  ++version_;
  std::erase_if(asked_, [&](int goal) { return of_cell_[goal] == nullptr; });
  outdated_.assign(asked_.rbegin(), asked_.rend());
  asked_.clear();
}

bool DistanceTables::refresh(std::size_t cells) {
  const std::size_t size = grid_.size();
  credit_ += cells;
  while (!outdated_.empty() && credit_ >= size) {
    const int goal = outdated_.back();
    Goal& entry = *of_cell_[goal];
    entry.version = version_;
    if (entry.table) entry.table->whole_ = computed(goal, costs_);
    credit_ -= size;
    outdated_.pop_back();
  }
  if (outdated_.empty()) credit_ = 0;
  return outdated_.empty();
}

/// Dial's algorithm (1969) backwards from the goal over poses: the buckets hold poses by cost modulo the largest cost.
std::vector<std::uint32_t> DistanceTables::computed(int goal, const Costs& costs) {
  const int cells = grid_.size();
  const auto& forward = costs.forward;
  std::uint32_t most = costs.turn;
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
      reach((cell << 2) | ((heading + 1) & 3), now + costs.turn);
      reach((cell << 2) | ((heading + 3) & 3), now + costs.turn);
      const int behind = grid_.ahead(cell, (heading + 2) & 3);
      if (behind >= 0) {
        const int before = (behind << 2) | heading;
        reach(before, now + (forward.empty() ? 1 : forward[before]));
      }
    }
    waiting -= bucket.size();
    bucket.clear();
  }
  std::vector<std::uint32_t> found(cells);
  for (int cell = 0; cell < cells; ++cell) {
    const std::uint32_t* const cost = &cost_[4 * static_cast<std::size_t>(cell)];
    const std::uint32_t best = std::min(*std::min_element(cost, cost + 4), DistanceTable::unreachable);
    std::uint32_t word = best << 12;
    for (int heading = 0; heading < 4; ++heading) word |= std::min(cost[heading] - best, 7u) << (3 * heading);
    found[cell] = word;
  }
  return found;
}

}  // namespace mrpbench::discrete
