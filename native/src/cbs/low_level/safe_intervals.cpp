#include "mrpbench_mapf/cbs/low_level/safe_intervals.hpp"

#include <algorithm>
#include <functional>

#include "mrpbench_mapf/single_agent/obstacles.hpp"

namespace mrpbench::mapf {

SafeIntervals::SafeIntervals(const Space& space, Limits& limits, Statistics& statistics)
    : space_(space), limits_(limits), statistics_(statistics), states_(space.vertex_count(), limits) {}

Tick SafeIntervals::least_cost(const ConstraintTable& table, DistanceTable& distance) {
  const Beginning& beginning = space_.instance().beginning(table.robot());
  const Tick since = enter_tick(beginning.occupied.back());
  const Tick cost = run(table, distance, table.latest_finish(), [&](const State& at, bool moved) {
    const Tick earliest = distance(at.vertex) == 0 ? table.earliest_finish(at.vertex) : kForever;
    if (earliest > at.last) return kForever;
    if (moved) return std::max(at.arrival, earliest);
    // A robot that never moves has finished when its beginning ends.
    return since >= earliest ? since : std::max(at.arrival + 1, earliest);
  });
  return cost <= table.latest_finish() ? cost : kForever;
}

Tick SafeIntervals::earliest(const ConstraintTable& table, DistanceTable& distance, int vertex, Tick latest) {
  return run(table, distance, latest,
             [&](const State& at, bool) { return at.vertex == vertex ? at.arrival : kForever; });
}

Tick SafeIntervals::earliest_exit(const ConstraintTable& table, DistanceTable& distance, std::span<const char> inside) {
  return run(table, distance, kForever, [&](const State& at, bool) {
    Tick soonest = kForever;
    for (const Move& move : space_.moves(table.robot(), at.vertex)) {
      const bool on_edge = inside[space_.vertex_count() + move.edge];
      if (on_edge ? inside[move.head] : !inside[at.vertex]) continue;
      const Tick depart = table.next_entry(at.vertex, move.edge, at.arrival);
      if (depart <= at.last) soonest = std::min(soonest, depart + (on_edge ? move.duration : 0));
    }
    return soonest;
  });
}

/// `cost_at(state, moved)`: what it costs to end there, kForever if that is not possible.
template <class CostAt>
Tick SafeIntervals::run(const ConstraintTable& table, DistanceTable& distance, Tick latest, CostAt cost_at) {
  const Beginning& beginning = space_.instance().beginning(table.robot());
  const Tick to_go = distance(beginning.vertex);
  if (to_go == kForever || table.forbids_beginning()) return kForever;
  begin(table);
  latest_ = std::max(latest, beginning.free_at);  // a robot that never moves has finished before it could
  int start = -1;
  const auto row = states_of(beginning.vertex);
  for (int k = row.first; k < row.last; ++k) {
    if (states_[k].first <= beginning.free_at && beginning.free_at <= states_[k].last) start = k;
  }
  if (start < 0) return kForever;
  states_[start].arrival = beginning.free_at;
  push(beginning.free_at + to_go, to_go, start);
  Tick found = kForever;
  while (!open_.empty()) {
    limits_.check();
    std::ranges::pop_heap(open_, std::greater{});
    const Open best = open_.back();
    open_.pop_back();
    if (best.state < 0) {
      found = best.f;
      break;
    }
    if (states_[best.state].closed) continue;
    states_[best.state].closed = true;
    ++statistics_.low_level_expansions;
    const State from = states_[best.state];
    if (const Tick cost = cost_at(from, best.state != start); cost < kForever) push(cost, 0, -1);
    for (const Move& move : space_.moves(table.robot(), from.vertex)) {
      const Tick h = distance(move.head);
      if (h == kForever) continue;
      const auto to = states_of(move.head);
      for (int k = to.first; k < to.last; ++k) {
        const Tick soonest = std::max(from.arrival, states_[k].first - move.duration);
        if (soonest > from.last) break;
        const Tick depart = table.next_entry(from.vertex, move.edge, soonest);
        if (depart == kForever) continue;
        const Tick arrive = depart + move.duration;
        if (depart > from.last || arrive > states_[k].last || arrive >= states_[k].arrival) continue;
        states_[k].arrival = arrive;
        push(arrive + h, h, k);
      }
    }
  }
  limits_.charge_growth(counted_, open_.capacity() * sizeof(Open));
  return found;
}

void SafeIntervals::begin(const ConstraintTable& table) {
  table_ = &table;
  states_.forget();
  open_.clear();
}

/// The states of a vertex, made when it is first touched: the gaps between what is forbidden that hold a tick.
LazyRows<SafeIntervals::State>::Row SafeIntervals::states_of(int vertex) {
  return states_.row(vertex, [&](std::vector<State>& states) {
    const auto add = [&](Half first, Half last) {
      const Tick begin = (first + 1) / 2, end = last / 2;
      if (first <= last && begin <= end) states.push_back({begin, end, kForever, vertex, false});
    };
    Half free = 0;
    if (table_->constrains(vertex)) {
      blocked_.clear();
      table_->at_vertex(vertex, blocked_);
      unite(blocked_);
      for (const Range& range : blocked_) {
        add(free, range.first - 1);
        free = range.last + 1;
      }
    }
    if (free <= kForeverHalf) add(free, kForeverHalf);
  });
}

void SafeIntervals::push(Tick f, Tick h, int state) {
  if (f > latest_) return;
  ++statistics_.low_level_generated;
  open_.push_back({f, h, state});
  std::ranges::push_heap(open_, std::greater{});
}

}  // namespace mrpbench::mapf
