#include "mrpbench_mapf/constraint.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

using Pair = std::array<Range, 2>;

/// Both stand: one instant at which both do.
Pair split_stays(const Occupation& a, const Occupation& b) {
  const Half instant = std::max(a.begin, b.begin);
  return {Range{instant, instant}, Range{instant, instant}};
}

/// One stands, the other passes by: the mover loses the departures from the present one to the last at which the stay
/// is still in its way, the one that stands the half-ticks that all these passages share.
Pair split_stay_and_move(const Occupation& stay, const Occupation& move) {
  const Tick depart = enter_tick(move), arrive = leave_tick(move);
  const Tick last = std::min(stay.end / 2, arrive) - 1;
  return {Range{2 * last + 1, 2 * arrive - 1}, Range{depart, last}};
}

/// Both move: departures d (of a) and e (of b) conflict exactly when least <= e - d <= greatest.
Pair split_moves(const Occupation& a, const Occupation& b, Relation relation) {
  const Tick a_enter = enter_tick(a), b_enter = enter_tick(b);
  const Tick a_ticks = leave_tick(a) - a_enter, b_ticks = leave_tick(b) - b_enter;
  const bool ordered = relation == Relation::ordered;
  const Tick least = ordered ? std::min(0, a_ticks - b_ticks) : 1 - b_ticks;
  const Tick greatest = ordered ? std::max(0, a_ticks - b_ticks) : a_ticks - 1;
  return {Range{a_enter, b_enter - least}, Range{b_enter, a_enter + greatest}};
}

}  // namespace

std::array<Constraint, 2> split(const PairConflict& conflict, std::span<const Occupation> one,
                                std::span<const Occupation> other, int vertex_count) {
  const Occupation &a = one[conflict.one_step], &b = other[conflict.other_step];
  const bool a_stands = a.element < vertex_count, b_stands = b.element < vertex_count;
  Pair ranges;
  if (a_stands && b_stands) {
    ranges = split_stays(a, b);
  } else if (a_stands) {
    ranges = split_stay_and_move(a, b);
  } else if (b_stands) {
    ranges = split_stay_and_move(b, a);
    std::swap(ranges[0], ranges[1]);
  } else {
    ranges = split_moves(a, b, conflict.relation);
  }
  return {Constraint{conflict.one, a.element, ranges[0]}, Constraint{conflict.other, b.element, ranges[1]}};
}

ConstraintTable::ConstraintTable(const Roadmap& roadmap, const Reservations& certain, Limits& limits)
    : certain_(certain), vertex_count_(roadmap.vertex_count()) {
  limits.charge(static_cast<std::size_t>(roadmap.element_count()) * sizeof(std::int32_t));
  head_.assign(roadmap.element_count(), -1);
}

void ConstraintTable::reset(int robot) {
  robot_ = robot;
  for (const std::int32_t element : touched_) head_[element] = -1;
  touched_.clear();
  entries_.clear();
}

void ConstraintTable::add(const Constraint& constraint) {
  std::int32_t& head = head_[constraint.element];
  if (head < 0) touched_.push_back(constraint.element);
  entries_.push_back({constraint.range, head});
  head = static_cast<std::int32_t>(entries_.size()) - 1;
}

void ConstraintTable::at_vertex(int vertex, std::vector<Range>& halves) const {
  list(vertex, halves);
  if (!certain_.empty()) certain_.at_vertex(robot_, vertex, halves);
}

void ConstraintTable::on_edge(int edge, Tick duration, std::vector<Range>& departures) const {
  list(vertex_count_ + edge, departures);
  if (!certain_.empty()) certain_.on_edge(robot_, edge, duration, departures);
}

void ConstraintTable::list(int element, std::vector<Range>& ranges) const {
  for (std::int32_t k = head_[element]; k >= 0; k = entries_[k].next) ranges.push_back(entries_[k].range);
}

}  // namespace mrpbench::mapf
