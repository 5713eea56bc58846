#include "mrpbench_mapf/cbs/constraints/constraint.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

using Pair = std::array<Range, 2>;

/// Both stand: one instant at which both do, or from which on the second follows too soon.
Pair split_stays(const Occupation& a, const Occupation& b, Tick k) {
  const Range window = window_from(std::min({std::max(a.begin, b.begin), a.end, b.end}), k);
  return {window, window};
}

/// One stands, the other passes by: the mover loses the departures from the present one to the last at which the stay
/// is still in its way, the one that stands the half-ticks that all these passages, widened by `k`, share.
Pair split_stay_and_move(const Occupation& stay, const Occupation& move, Tick k) {
  const Tick depart = enter_tick(move), arrive = leave_tick(move);
  const Tick last = std::min(stay.end / 2 + k, arrive + 2 * k) - 1;
  return {Range{std::max(0, 2 * (last - k) + 1), 2 * (arrive + k) - 1}, Range{depart, last}};
}

/// Both move: departures d (of a) and e (of b) conflict exactly when least <= e - d <= greatest.
Pair split_moves(const Occupation& a, const Occupation& b, Relation relation, Tick k) {
  const Tick a_enter = enter_tick(a), b_enter = enter_tick(b);
  const Tick a_ticks = leave_tick(a) - a_enter, b_ticks = leave_tick(b) - b_enter;
  const bool ordered = relation == Relation::ordered;
  const Tick least = ordered ? std::min(0, a_ticks - b_ticks) : 1 - b_ticks - k;
  const Tick greatest = ordered ? std::max(0, a_ticks - b_ticks) : a_ticks - 1 + k;
  return {Range{a_enter, b_enter - least}, Range{b_enter, a_enter + greatest}};
}

}  // namespace

std::array<Constraint, 2> split(const PairConflict& conflict, std::span<const Occupation> one,
                                std::span<const Occupation> other, int vertex_count, Tick k) {
  const Occupation &a = one[conflict.one_step], &b = other[conflict.other_step];
  const bool a_stands = a.element < vertex_count, b_stands = b.element < vertex_count;
  Pair ranges;
  if (a_stands && b_stands) {
    ranges = split_stays(a, b, k);
  } else if (a_stands) {
    ranges = split_stay_and_move(a, b, k);
  } else if (b_stands) {
    ranges = split_stay_and_move(b, a, k);
    std::swap(ranges[0], ranges[1]);
  } else {
    ranges = split_moves(a, b, conflict.relation, k);
  }
  return {Constraint{conflict.one, a.element, ranges[0]}, Constraint{conflict.other, b.element, ranges[1]}};
}

}  // namespace mrpbench::mapf
