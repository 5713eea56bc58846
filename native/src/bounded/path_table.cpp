#include "mrpbench_mapf/bounded/path_table.hpp"

#include <algorithm>
#include <new>

namespace mrpbench::mapf {

PathTable::PathTable(int vertex_count, int robots, Limits& limits)
    : vertex_count_(vertex_count), limits_(limits), next_(robots), paths_(robots) {
  limits.charge(static_cast<std::size_t>(vertex_count) * (sizeof(Tick) + sizeof(std::int32_t)));
  parked_from_.assign(vertex_count, kForever);
  parked_.assign(vertex_count, -1);
}

void PathTable::grow() {
  constexpr std::size_t kBlock = 1 << 19;  // cells
  const std::size_t rows = std::max<std::size_t>(1, kBlock / vertex_count_);
  limits_.charge(rows * vertex_count_ * sizeof(std::uint16_t));
  auto* block = static_cast<std::uint16_t*>(std::calloc(rows * vertex_count_, sizeof(std::uint16_t)));
  if (block == nullptr) throw std::bad_alloc();
  blocks_.emplace_back(block);
  for (std::size_t i = 0; i < rows; ++i) row_.push_back(block + i * vertex_count_);
}

void PathTable::add(int robot, Steps steps) {
  const auto ticks = static_cast<Tick>(steps.size());
  while (ticks > static_cast<Tick>(row_.size())) grow();
  ticks_ = std::max(ticks_, ticks);
  paths_[robot] = steps;
  std::vector<std::uint16_t>& next = next_[robot];
  if (next.size() < steps.size()) next.resize(steps.size());
  for (Tick tick = 0; tick < ticks; ++tick) {
    std::uint16_t& head = row_[tick][steps[tick]];
    next[tick] = head;
    head = static_cast<std::uint16_t>(robot + 1);
  }
  parked_from_[steps.back()] = ticks;
  parked_[steps.back()] = robot;
}

void PathTable::remove(int robot) {
  const Steps steps = paths_[robot];
  const auto own = static_cast<std::uint16_t>(robot + 1);
  for (Tick tick = 0; tick < static_cast<Tick>(steps.size()); ++tick) {
    std::uint16_t* link = &row_[tick][steps[tick]];
    while (*link != own) link = &next_[*link - 1][tick];
    *link = next_[robot][tick];
  }
  parked_from_[steps.back()] = kForever;
  paths_[robot] = {};
}

}  // namespace mrpbench::mapf
