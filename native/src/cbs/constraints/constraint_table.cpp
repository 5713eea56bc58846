#include "mrpbench_mapf/cbs/constraints/constraint_table.hpp"

#include <algorithm>

namespace mrpbench::mapf {

ConstraintTable::ConstraintTable(const Space& space, Limits& limits) : space_(space), limits_(limits) {
  limits.charge(static_cast<std::size_t>(space.vertex_count()) * sizeof(std::int32_t));
  head_.assign(space.vertex_count(), -1);
}

void ConstraintTable::reset(int robot, int goal) {
  robot_ = robot;
  goal_ = goal;
  settled_ = 0;
  finish_at_ = TimedPath::kAnyGoal;
  latest_finish_ = kForever;
  forbids_beginning_ = false;
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
    case Constraint::Kind::length_above:
      if (mine) forbid_finishing(constraint.element, constraint.range.first);
      break;
    case Constraint::Kind::length_at_most:
      if (mine) {
        finish_at_ = constraint.element;
        latest_finish_ = std::min(latest_finish_, constraint.range.first);
      } else {
        make_way(constraint);
      }
      break;
    case Constraint::Kind::resource:
      if (mine) forbid_resource(constraint.element, constraint.range);
      break;
    case Constraint::Kind::junction:
      if (mine) forbid_junction(constraint.element, constraint.range);
      break;
  }
}

void ConstraintTable::forbid(int element, Range range) {
  const int vertices = space_.vertex_count();
  const bool is_vertex = element < vertices;
  const int edge = element - vertices;
  enter(is_vertex ? element : space_.instance().roadmap().tail(edge), {is_vertex ? kVertex : edge, range, -1});
  const std::int32_t forever = is_vertex ? kForeverHalf : kForever;
  const std::int32_t change = range.last >= forever ? range.first : range.last + 1;
  settled_ = std::max(settled_, is_vertex ? (change + 1) / 2 : change);
}

void ConstraintTable::forbid_finishing(int vertex, Tick until) {
  enter(vertex, {kFinish, {0, until}, -1});
  if (until < kForever) settled_ = std::max(settled_, until + 1);
}

void ConstraintTable::enter(int vertex, const Entry& entry) {
  std::int32_t& head = head_[vertex];
  if (head < 0) touched_.push_back(vertex);
  entries_.push_back({entry.edge, entry.range, head});
  head = static_cast<std::int32_t>(entries_.size()) - 1;
  limits_.charge_growth(counted_, entries_.capacity() * sizeof(Entry));
}

/// Another robot stands at its goal for good: nothing that excludes the goal may be occupied any more.
void ConstraintTable::make_way(const Constraint& parked) {
  const Tick from = parked.range.first;
  if (space_.classical()) return forbid(parked.element, {2 * from, kForeverHalf});
  const Instance& instance = space_.instance();
  const double reach = instance.reach(robot_, parked.robot);
  const Half since = widened(2 * from, 2 * from, instance.rules().k).first;
  for (const Near& near : space_.relations().row(parked.element)) {
    if (near.relation(reach) == Relation::exclusive) keep_away(near.element, {since, kForeverHalf});
  }
  for (const std::int32_t resource : instance.resources_of(parked.element)) {
    forbid_resource(resource, {2 * from, kForeverHalf});
  }
}

/// A robot that leaves a resource uses it for the setup after that.
void ConstraintTable::forbid_resource(int resource, Range halves) {
  const Resource& it = space_.instance().resources()[resource];
  halves.first = static_cast<Half>(std::max<std::int64_t>(0, halves.first - std::int64_t{2} * it.setup));
  for (const int element : it.elements) keep_away(element, halves);
}

void ConstraintTable::forbid_junction(int junction, Range halves) {
  const Roadmap& roadmap = space_.instance().roadmap();
  keep_away(junction, halves);
  for (const int edge : roadmap.out(junction)) keep_away(space_.vertex_count() + edge, halves);
  for (const int edge : roadmap.in(junction)) keep_away(space_.vertex_count() + edge, halves);
}

/// Nothing that is done at `halves` may be done there.
void ConstraintTable::keep_away(int element, Range halves) {
  const Instance& instance = space_.instance();
  for (const Occupation& it : instance.beginning(robot_).occupied) {  // may take longer than it would have to
    forbids_beginning_ |= it.element == element && it.begin <= halves.last && it.end >= halves.first;
  }
  const int edge = element - space_.vertex_count();
  if (edge < 0) return forbid(element, halves);
  const Tick ticks = instance.roadmap().duration(instance.robots()[robot_].profile)[edge];
  const Tick last = halves.last >= kForeverHalf ? kForever : (halves.last - 1) >> 1;
  const Tick first = halves.first / 2 + 1 - ticks;  // [2d + 1, 2(d + ticks) - 1] must not meet `halves`
  if (ticks > 0 && first <= last) forbid(element, {first, last});
}

void ConstraintTable::at_vertex(int vertex, std::vector<Range>& halves) const {
  for (std::int32_t k = head_[vertex]; k >= 0; k = entries_[k].next) {
    if (entries_[k].edge == kVertex) halves.push_back(entries_[k].range);
  }
}

Tick ConstraintTable::next_entry(int vertex, int edge, Tick at) const {
  for (std::int32_t k = head_[vertex]; k >= 0;) {
    const Entry& entry = entries_[k];
    const bool blocked = entry.edge == edge && entry.range.first <= at && entry.range.last >= at;
    if (blocked && entry.range.last >= kForever) return kForever;
    if (blocked) at = entry.range.last + 1;
    k = blocked ? head_[vertex] : entry.next;  // the others may forbid the new tick
  }
  return at;
}

bool ConstraintTable::forbids_beginning() const {
  if (forbids_beginning_) return true;
  for (const Occupation& it : space_.instance().beginning(robot_).occupied) {
    if (it.element < space_.vertex_count()) {
      if (blocked(it.element, kVertex, it.begin, it.end)) return true;
    } else {
      const int edge = it.element - space_.vertex_count();
      if (forbids_entering(space_.instance().roadmap().tail(edge), edge, enter_tick(it))) return true;
    }
  }
  return false;
}

Tick ConstraintTable::earliest_finish(int vertex) const {
  if (finish_at_ != TimedPath::kAnyGoal && finish_at_ != vertex) return kForever;
  const bool stays = !space_.instance().rules().disappear_at_goal;
  Tick earliest = 0;
  for (std::int32_t k = head_[vertex]; k >= 0; k = entries_[k].next) {
    const auto& [edge, range, next] = entries_[k];
    if (edge == kFinish) {
      if (range.last >= kForever) return kForever;
      earliest = std::max(earliest, range.last + 1);
    } else if (edge == kVertex && stays) {
      if (range.last >= kForeverHalf) return kForever;
      earliest = std::max(earliest, range.last / 2 + 1);
    }
  }
  return earliest;
}

Tick ConstraintTable::earliest_finish() const {
  if (goal_ != TimedPath::kAnyGoal) return earliest_finish(goal_);
  Tick earliest = kForever;
  for (const int goal : space_.instance().robots()[robot_].goals) earliest = std::min(earliest, earliest_finish(goal));
  return earliest;
}

}  // namespace mrpbench::mapf
