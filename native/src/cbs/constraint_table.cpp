#include "mrpbench_mapf/cbs/constraint_table.hpp"

#include <algorithm>

namespace mrpbench::mapf {

ConstraintTable::ConstraintTable(const Space& space, Limits& limits) : space_(space), limits_(limits) {
  limits.charge(static_cast<std::size_t>(space.vertex_count()) * sizeof(std::int32_t));
  head_.assign(space.vertex_count(), -1);
}

void ConstraintTable::reset(int robot) {
  robot_ = robot;
  settled_ = 0;
  finish_after_ = -1;
  latest_finish_ = kForever;
  for (const std::int32_t vertex : touched_) head_[vertex] = -1;
  touched_.clear();
  entries_.clear();
  add(space_.certain(robot));
}

void ConstraintTable::add(const Constraint& constraint) {
  const bool mine = constraint.robot == robot_;
  switch (constraint.kind) {
    case Constraint::Kind::avoid:
      if (mine) forbid(constraint.element, constraint.range);
      break;
    case Constraint::Kind::finish_after:
      if (!mine) break;
      finish_after_ = std::max(finish_after_, constraint.range.first);
      settled_ = std::max(settled_, finish_after_ + 1);
      break;
    case Constraint::Kind::finish_by:
      if (mine) {
        latest_finish_ = std::min(latest_finish_, constraint.range.first);
      } else {
        keep_clear(constraint);
      }
      break;
  }
}

void ConstraintTable::forbid(int element, Range range) {
  const int vertices = space_.vertex_count();
  const bool is_vertex = element < vertices;
  std::int32_t& head = head_[is_vertex ? element : space_.instance().roadmap().tail(element - vertices)];
  if (head < 0) touched_.push_back(static_cast<std::int32_t>(&head - head_.data()));
  entries_.push_back({is_vertex ? -1 : element - vertices, range, head});
  head = static_cast<std::int32_t>(entries_.size()) - 1;
  const std::int32_t forever = is_vertex ? kForeverHalf : kForever;
  const std::int32_t change = range.last >= forever ? range.first : range.last + 1;
  settled_ = std::max(settled_, is_vertex ? (change + 1) / 2 : change);
  limits_.charge_growth(counted_, entries_.capacity() * sizeof(Entry));
}

/// Another robot stands at its goal for good: nothing that excludes the goal may be occupied any more.
void ConstraintTable::keep_clear(const Constraint& parked) {
  const Tick from = parked.range.first;
  if (space_.textbook()) return forbid(parked.element, {2 * from, kForeverHalf});
  const Instance& instance = space_.instance();
  const int vertices = space_.vertex_count();
  const double reach = instance.reach(robot_, parked.robot);
  const std::span<const Tick> duration = instance.roadmap().duration(instance.robots()[robot_].profile);
  for (const Near& near : space_.relations().row(parked.element)) {
    if (near.relation(reach) != Relation::exclusive) continue;
    if (near.element < vertices) {
      forbid(near.element, {2 * from, kForeverHalf});
    } else if (const Tick ticks = duration[near.element - vertices]; ticks > 0) {
      forbid(near.element, {from - ticks + 1, kForever});
    }
  }
}

bool ConstraintTable::forbids_beginning() const {
  for (const Occupation& it : space_.instance().beginning(robot_).occupied) {
    if (it.element < space_.vertex_count()) {
      if (blocked(it.element, -1, it.begin, it.end)) return true;
    } else {
      const int edge = it.element - space_.vertex_count();
      if (forbids_entering(space_.instance().roadmap().tail(edge), edge, enter_tick(it))) return true;
    }
  }
  return false;
}

Tick ConstraintTable::earliest_finish(int vertex) const {
  Tick earliest = finish_after_ + 1;
  if (space_.instance().rules().disappear_at_goal) return earliest;
  for (std::int32_t k = head_[vertex]; k >= 0; k = entries_[k].next) {
    if (entries_[k].edge >= 0) continue;
    if (entries_[k].range.last >= kForeverHalf) return kForever;
    earliest = std::max(earliest, entries_[k].range.last / 2 + 1);
  }
  return earliest;
}

Tick ConstraintTable::earliest_finish() const {
  Tick earliest = kForever;
  for (const int goal : space_.instance().robots()[robot_].goals) earliest = std::min(earliest, earliest_finish(goal));
  return earliest;
}

}  // namespace mrpbench::mapf
