#include "mrpbench_mapf/cbs/low_level/soft_intervals.hpp"

#include <algorithm>
#include <functional>
#include <tuple>

#include "mrpbench_mapf/single_agent/obstacles.hpp"

namespace mrpbench::mapf {

SoftIntervals::SoftIntervals(const Space& space, Limits& limits, Statistics& statistics)
    : space_(space),
      limits_(limits),
      statistics_(statistics),
      states_(space.vertex_count(), limits),
      departures_(space.instance().roadmap().edge_count(), limits) {}

bool SoftIntervals::search(const ConstraintTable& table, DistanceTable& distance, const AvoidanceTable* others,
                           Tick latest, FoundPath& path) {
  const Beginning& beginning = space_.instance().beginning(table.robot());
  path.goal = table.goal();
  if (distance(beginning.vertex) == kForever || table.forbids_beginning()) return false;
  table_ = &table;
  distance_ = &distance;
  others_ = others;
  latest_ = latest;
  states_.forget();
  departures_.forget();
  labels_.clear();
  open_.clear();
  const auto row = states_of(beginning.vertex);
  for (std::int32_t state = row.first; state < row.last; ++state) {
    if (states_[state].first > beginning.free_at || states_[state].last < beginning.free_at) continue;
    // A robot that never moves has finished before it could.
    if (distance(beginning.vertex) == 0 || beginning.free_at <= latest) {
      reach(-1, state, -1, beginning.free_at, states_[state].present);
    }
  }
  bool found = false;
  while (!open_.empty() && !found) {
    limits_.check();
    std::ranges::pop_heap(open_, std::greater{});
    const std::int32_t label = open_.back().label;
    open_.pop_back();
    found = labels_[label].cost >= 0;
    if (found) {
      trace(label, path);
      continue;
    }
    State& state = states_[labels_[label].state];
    if (labels_[label].arrival >= state.closed) continue;
    state.closed = labels_[label].arrival;
    expand(label);
  }
  limits_.charge_growth(counted_, labels_.capacity() * sizeof(Label) + open_.capacity() * sizeof(Open));
  return found;
}

LazyRows<SoftIntervals::State>::Row SoftIntervals::states_of(int vertex) {
  return states_.row(vertex, [&](std::vector<State>& states) {
    blocked_.clear();
    visits_.clear();
    if (table_->constrains(vertex)) table_->at_vertex(vertex, blocked_);
    unite(blocked_);
    if (others_ != nullptr) others_->reservations().at_vertex(table_->robot(), vertex, visits_);
    std::ranges::sort(visits_, {}, &Range::first);
    Half free = 0;
    for (const Range& range : blocked_) {
      if (free < range.first) add_shared(vertex, free, range.first - 1, states);
      free = range.last + 1;
    }
    if (free <= kForeverHalf) add_shared(vertex, free, kForeverHalf, states);
  });
}

/// Cut an interval without constraints where visits of others begin and end.
void SoftIntervals::add_shared(int vertex, Half free, Half until, std::vector<State>& states) {
  ends_.clear();
  for (const Range& visit : visits_) ends_.push_back(visit.last);
  std::ranges::sort(ends_);
  std::int32_t present = 0, begun = 0;
  std::size_t next = 0, ended = 0;
  for (Half from = free; from <= until;) {
    for (; next < visits_.size() && visits_[next].first <= from; ++next) ++present, ++begun;
    for (; ended < ends_.size() && ends_[ended] < from; ++ended) --present;
    Half last = until;
    if (next < visits_.size()) last = std::min(last, visits_[next].first - 1);
    if (ended < ends_.size()) last = std::min(last, ends_[ended]);
    if ((from + 1) / 2 <= last / 2) {
      states.push_back({(from + 1) / 2, last / 2, until / 2, vertex, present, begun, kForever});
      begun = 0;  // else it lies between two ticks: a robot that waits on meets them as well
    }
    if (last == kForeverHalf) break;
    from = last + 1;
  }
}

std::span<const Range> SoftIntervals::departures_of(const Move& move) {
  if (others_ == nullptr) return {};
  return departures_.items(departures_.row(move.edge, [&](std::vector<Range>& departures) {
    others_->reservations().on_edge(table_->robot(), move.edge, move.duration, departures);
  }));
}

void SoftIntervals::expand(std::int32_t label) {
  ++statistics_.low_level_expansions;
  const Label from = labels_[label];
  const State here = states_[from.state];
  if (from.edge >= 0 || from.parent < 0) finish(label);
  for (const Move& move : space_.moves(table_->robot(), here.vertex)) {
    const Tick h = (*distance_)(move.head);
    if (h == kForever || from.arrival + move.duration + h > latest_) continue;
    const auto row = states_of(move.head);
    for (std::int32_t to = row.first; to < row.last; ++to) {
      if (states_[to].last < from.arrival + move.duration) continue;
      if (states_[to].first - move.duration > here.last) break;
      follow(label, move, to);
    }
  }
  const std::int32_t next = from.state + 1;
  if (next < states_of(here.vertex).last && states_[next].free_until == here.free_until) {
    reach(label, next, -1, states_[next].first, from.conflicts + states_[next].begun);
  }
}

/// Make `move` into the interval `to` as early as possible and, if that conflicts, as early as it does not.
void SoftIntervals::follow(std::int32_t label, const Move& move, std::int32_t to) {
  const Label from = labels_[label];
  const State here = states_[from.state], there = states_[to];
  const Tick last = std::min(here.last, there.last - move.duration);
  const auto enter = [&](Tick at) { return table_->next_entry(here.vertex, move.edge, at); };
  Tick departure = enter(std::max(from.arrival, there.first - move.duration));
  if (departure > last) return;
  const std::span<const Range> ranges = departures_of(move);
  const auto met = [&](const Range& it) { return it.first <= departure && departure <= it.last; };
  const auto number = static_cast<std::int32_t>(std::ranges::count_if(ranges, met));
  reach(label, to, move.edge, departure + move.duration, from.conflicts + there.present + number);
  if (number == 0) return;
  for (auto range = ranges.begin(); range != ranges.end() && departure <= last;) {
    if (!met(*range)) {
      ++range;
      continue;
    }
    departure = enter(range->last + 1);
    range = ranges.begin();
  }
  if (departure <= last) reach(label, to, move.edge, departure + move.duration, from.conflicts + there.present);
}

/// The path may end here, with a conflict for each robot that comes later.
void SoftIntervals::finish(std::int32_t label) {
  Label end = labels_[label];
  const State here = states_[end.state];
  if ((*distance_)(here.vertex) != 0) return;
  const Tick earliest = table_->earliest_finish(here.vertex);
  if (earliest > here.free_until) return;
  const Beginning& beginning = space_.instance().beginning(table_->robot());
  const Tick since = enter_tick(beginning.occupied.back());
  if (end.parent >= 0) {
    end.cost = std::max(end.arrival, earliest);
  } else {
    end.cost = since >= earliest ? since : std::max(end.arrival + 1, earliest);
  }
  if (end.cost > latest_) return;
  if (!space_.instance().rules().disappear_at_goal) {
    const auto row = states_of(here.vertex);
    for (std::int32_t later = end.state + 1; later < row.last; ++later) end.conflicts += states_[later].begun;
  }
  push(end, end.cost, 0);
}

void SoftIntervals::reach(std::int32_t parent, std::int32_t to, std::int32_t edge, Tick arrival,
                          std::int32_t conflicts) {
  const State& state = states_[to];
  const Tick h = (*distance_)(state.vertex);
  if (arrival >= state.closed || (parent >= 0 && arrival + h > latest_)) return;
  push({arrival, conflicts, to, parent, edge, -1}, arrival + h, h);
}

void SoftIntervals::push(const Label& label, Tick f, Tick h) {
  ++statistics_.low_level_generated;
  open_.push_back({label.conflicts, f, h, static_cast<std::int32_t>(labels_.size())});
  labels_.push_back(label);
  std::ranges::push_heap(open_, std::greater{});
}

void SoftIntervals::trace(std::int32_t label, FoundPath& path) {
  const int robot = table_->robot();
  const auto vertex_of = [&](const Label& it) { return states_[it.state].vertex; };
  const Label& end = labels_[label];
  stops_.clear();
  if (end.cost > end.arrival) stops_.push_back({vertex_of(end), end.cost, -1});
  for (std::int32_t it = label; labels_[it].parent >= 0; it = labels_[it].parent) {
    const Label &reached = labels_[it], &from = labels_[reached.parent];
    stops_.push_back({vertex_of(reached), reached.arrival, reached.edge});
    if (reached.edge < 0) continue;
    const Tick ticks = space_.instance().roadmap().duration(space_.instance().robots()[robot].profile)[reached.edge];
    if (reached.arrival - ticks > from.arrival) stops_.push_back({vertex_of(from), reached.arrival - ticks, -1});
  }
  const Beginning& beginning = space_.instance().beginning(robot);
  stops_.push_back({beginning.vertex, beginning.free_at, -1});
  std::ranges::reverse(stops_);
  mapf::follow(space_, robot, stops_, path);
}

}  // namespace mrpbench::mapf
