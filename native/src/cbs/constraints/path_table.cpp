#include "mrpbench_mapf/cbs/constraints/path_table.hpp"

#include <new>

namespace mrpbench::mapf {

PathTable::PathTable(int vertex_count, int robots, Limits& limits)
    : vertex_count_(vertex_count), limits_(limits), next_(robots), paths_(robots) {
  limits.charge(static_cast<std::size_t>(vertex_count) * (sizeof(std::int32_t) + sizeof(std::uint16_t)));
  visits_.assign(vertex_count, 0);
  parked_.assign(vertex_count, 0);
  next_parked_.assign(robots, 0);
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

void PathTable::add(int robot, const TimedPath& path) {
  if (path.empty()) return;
  const auto ticks = static_cast<Tick>(path.at.size());
  while (ticks > static_cast<Tick>(row_.size())) grow();
  ticks_ = std::max(ticks_, ticks);
  paths_[robot] = path;
  std::vector<std::uint16_t>& next = next_[robot];
  if (next.size() < path.at.size()) next.resize(path.at.size());
  const auto own = static_cast<std::uint16_t>(robot + 1);
  for (Tick tick = 0; tick < ticks; ++tick) {
    std::uint16_t& head = row_[tick][path.at[tick]];
    next[tick] = head;
    head = own;
    ++visits_[path.at[tick]];
  }
  if (!path.stays) return;
  next_parked_[robot] = parked_[path.at.back()];
  parked_[path.at.back()] = own;
}

void PathTable::remove(int robot) {
  const TimedPath& path = paths_[robot];
  if (path.at.empty()) return;
  const auto own = static_cast<std::uint16_t>(robot + 1);
  for (Tick tick = 0; tick < static_cast<Tick>(path.at.size()); ++tick) {
    std::uint16_t* link = &row_[tick][path.at[tick]];
    while (*link != own) link = &next_[*link - 1][tick];
    *link = next_[robot][tick];
    --visits_[path.at[tick]];
  }
  if (path.stays) {
    std::uint16_t* link = &parked_[path.at.back()];
    while (*link != own) link = &next_parked_[*link - 1];
    *link = next_parked_[robot];
  }
  paths_[robot] = {};
}

}  // namespace mrpbench::mapf
