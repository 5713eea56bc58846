#include "mrpbench_mapf/cbs/avoidance_table.hpp"

#include <algorithm>
#include <bit>

namespace mrpbench::mapf {

AvoidanceTable::AvoidanceTable(const Space& space, Limits& limits)
    : space_(space), limits_(limits), textbook_(space.textbook()), vertices_(space.vertex_count()) {
  const auto robots = static_cast<std::size_t>(space.instance().size());
  if (!textbook_) {
    reservations_.emplace(space.instance(), space.relations(), limits);
    paths_.resize(robots);
    return;
  }
  slots_.resize(1 << 10);
  shift_ = 64 - 10;
  limits.charge(slots_.size() * sizeof(Slot) + vertices_ * sizeof(std::int32_t) + robots * sizeof(Parked));
  parked_head_.assign(vertices_, -1);
  parked_.assign(robots, {-1, -1});
}

void AvoidanceTable::add(int robot, const TimedPath& path) {
  if (textbook_) return change(robot, path, 1);
  paths_[robot] = path;
  stale_ = true;
}

void AvoidanceTable::remove(int robot, const TimedPath& path) {
  if (textbook_) return change(robot, path, -1);
  paths_[robot] = {};
  stale_ = true;
}

void AvoidanceTable::clear() {
  if (!textbook_) {
    for (TimedPath& path : paths_) path = {};
    stale_ = true;
    return;
  }
  std::ranges::fill(slots_, Slot{});
  used_ = 0;
  std::ranges::fill(parked_head_, -1);
}

void AvoidanceTable::refresh() {
  if (!stale_) return;
  stale_ = false;
  reservations_->clear();
  for (std::size_t robot = 0; robot < paths_.size(); ++robot) {
    reservations_->add(static_cast<int>(robot), paths_[robot].occupied);
  }
}

void AvoidanceTable::change(int robot, const TimedPath& path, int by) {
  const std::span<const std::int32_t> at = path.at;
  for (Tick tick = 0; tick < static_cast<Tick>(at.size()); ++tick) {
    change(key(at[tick], tick), by);
    if (tick == 0 || at[tick] == at[tick - 1]) continue;
    change(key(vertices_ + space_.lane(at[tick - 1], at[tick]), tick - 1), by);
  }
  if (!path.stays) return;
  std::int32_t* place = &parked_head_[at.back()];
  if (by > 0) {
    parked_[robot] = {path.last_tick() + 1, *place};
    *place = robot;
  } else {
    while (*place != robot) place = &parked_[*place].next;
    *place = parked_[robot].next;
  }
}

void AvoidanceTable::change(std::uint64_t key, int by) {
  Slot& slot = slots_[place(key)];
  if (slot.key == kFree) {
    slot.key = key;
    ++used_;
  }
  slot.count += by;
  if (2 * used_ > slots_.size()) rehash();
}

/// Make room, leaving out what is no longer counted.
void AvoidanceTable::rehash() {
  const auto counted =
      static_cast<std::size_t>(std::ranges::count_if(slots_, [](const Slot& it) { return it.count > 0; }));
  const std::size_t size = std::bit_ceil(std::max<std::size_t>(4 * counted, 1 << 10));
  if (size > slots_.size()) limits_.charge((size - slots_.size()) * sizeof(Slot));
  std::vector<Slot> old(size);
  old.swap(slots_);
  shift_ = 64 - std::countr_zero(size);
  used_ = counted;
  for (const Slot& slot : old) {
    if (slot.count > 0) slots_[place(slot.key)] = slot;
  }
}

int AvoidanceTable::parked(int vertex, Tick at) const {
  int number = 0;
  for (std::int32_t robot = parked_head_[vertex]; robot >= 0; robot = parked_[robot].next) {
    number += parked_[robot].from <= at;
  }
  return number;
}

int AvoidanceTable::moving_on_lanes(int robot, const Move& move, Tick at) const {
  const Tick arrive = at + move.duration;
  return reservations_->count(robot, on_edge(vertices_ + move.edge, at, arrive)) +
         reservations_->count(robot, at_vertex(move.head, arrive, arrive));
}

}  // namespace mrpbench::mapf
