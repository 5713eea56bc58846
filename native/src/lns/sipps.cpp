#include "lns/sipps.hpp"

#include <algorithm>
#include <functional>

#include "mrpbench_mapf/single_agent/obstacles.hpp"

namespace mrpbench::mapf::lns {

Sipps::Sipps(const Traffic& traffic, std::uint64_t seed, Limits& limits, Statistics& statistics)
    : traffic_(traffic),
      instance_(traffic.instance()),
      roadmap_(instance_.roadmap()),
      limits_(limits),
      statistics_(statistics),
      random_(seed),
      states_(roadmap_.vertex_count(), limits),
      departures_(roadmap_.edge_count(), limits) {
  for (int profile = 0; profile < roadmap_.profile_count(); ++profile) gather_ways(profile);
}

void Sipps::gather_ways(int profile) {
  limits_.charge(static_cast<std::size_t>(roadmap_.vertex_count() + 1) * sizeof(std::int32_t) +
                 static_cast<std::size_t>(roadmap_.edge_count()) * sizeof(Way));
  const std::span<const Tick> duration = roadmap_.duration(profile);
  Ways& ways = ways_.emplace_back();
  ways.first.push_back(0);
  for (int vertex = 0; vertex < roadmap_.vertex_count(); ++vertex) {
    for (const int edge : roadmap_.out(vertex)) {
      if (duration[edge] > 0) ways.way.push_back({edge, roadmap_.head(edge), duration[edge]});
    }
    ways.first.push_back(static_cast<std::int32_t>(ways.way.size()));
  }
}

bool Sipps::search(int robot, DistanceTable& distance, Others others, Tick latest, Path& path) {
  others_ = others;
  distance_ = &distance;
  latest_ = latest;
  begin(robot);
  const Beginning& beginning = instance_.beginning(robot);
  const Tick to_go = distance(beginning.vertex);
  if (to_go == kForever) return false;
  alone_ = beginning.free_at + to_go;
  least_ = is_soft() ? 0 : earliest_stay();
  if (least_ > latest) return false;
  const Row row = states_of(beginning.vertex);
  for (int state = row.first; state < row.last; ++state) {
    if (states_[state].first > beginning.free_at || states_[state].last < beginning.free_at) continue;
    reach(-1, state, -1, beginning.free_at, states_[state].occupancy.present);
  }
  bool found = false;
  while (!open_.empty() && !found) {
    limits_.check();
    std::ranges::pop_heap(open_, std::greater{});
    const int label = open_.back().label;
    open_.pop_back();
    if (labels_[label].final) {
      trace(label, path);
      found = true;
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

void Sipps::begin(int robot) {
  robot_ = robot;
  duration_ = roadmap_.duration(instance_.robots()[robot].profile);
  out_ = &ways_[instance_.robots()[robot].profile];
  states_.forget();
  departures_.forget();
  labels_.clear();
  open_.clear();
}

/// Earliest tick from which some goal is free for good.
Tick Sipps::earliest_stay() {
  if (instance_.rules().disappear_at_goal) return 0;
  Tick earliest = kForever;
  for (const int goal : instance_.robots()[robot_].goals) {
    const Row row = states_of(goal);
    if (row.size() == 0) continue;
    const State& last = states_[row.last - 1];
    if (last.last == kForever) earliest = std::min(earliest, last.first);
  }
  return earliest;
}

Sipps::Row Sipps::states_of(int vertex) {
  return states_.row(vertex, [&](std::vector<State>& states) {
    if (is_soft()) {
      add_shared(vertex, states);
    } else {
      add_free(vertex, states);
    }
  });
}

/// The visits that exclude the robot from `vertex`, and times at which resources are full, by their beginnings.
std::span<const Visit> Sipps::visits_at(int vertex) {
  const std::span<const Near> row = traffic_.relations().row(vertex);
  const std::span<const std::int32_t> resources = instance_.resources_of(vertex);
  const Tick k = instance_.rules().k;
  if (row.size() == 1 && resources.empty() && k == 0) return traffic_.at(vertex);
  visits_.clear();
  for (const Near& near : row) {
    for (const Visit& visit : traffic_.at(near.element)) {
      if (near.distance >= instance_.reach(robot_, visit.robot)) continue;
      const Range late = widened(visit.begin, visit.end, k);
      visits_.push_back({late.first, late.last, visit.robot});
    }
  }
  ranges_.clear();
  for (const std::int32_t resource : resources) traffic_.users().full(robot_, resource, ranges_);
  for (const Range& full : ranges_) visits_.push_back({full.first, full.last, -1});
  std::ranges::sort(visits_, {}, &Visit::begin);
  return visits_;
}

/// When the robot can be at `vertex`: not before it could get there, and not too late to arrive in time.
Sipps::Window Sipps::window_of(int vertex) {
  const Tick h = (*distance_)(vertex);
  const bool stays = is_soft() && h == 0 && !instance_.rules().disappear_at_goal;  // meets all that come later
  return {2 * (alone_ - h), stays ? kForeverHalf : 2 * (latest_ - h)};
}

void Sipps::add_free(int vertex, std::vector<State>& states) {
  const Window window = window_of(vertex);
  Half free = 0;
  std::int32_t before = -1;
  for (const Visit& visit : visits_at(vertex)) {
    if (free > window.last) return;
    if (visit.begin > free && visit.begin > window.first)
      add_state(states, vertex, free, visit.begin - 1, {.before = before, .after = visit.robot});
    free = std::max(free, visit.end + 1);
    before = visit.robot;
  }
  if (free <= window.last) add_state(states, vertex, free, kForeverHalf, {.before = before});
}

void Sipps::add_shared(int vertex, std::vector<State>& states) {
  const Window window = window_of(vertex);
  const std::span<const Visit> visits = visits_at(vertex);
  ends_.clear();
  for (const Visit& visit : visits) ends_.push_back(visit.end);
  std::ranges::sort(ends_);
  Half from = 0;
  int present = 0, begun = 0;
  std::size_t next = 0, ended = 0;
  while (from <= window.last) {
    for (; next < visits.size() && visits[next].begin <= from; ++next) ++present, ++begun;
    for (; ended < ends_.size() && ends_[ended] < from; ++ended) --present;
    Half until = kForeverHalf;
    if (next < visits.size()) until = std::min(until, visits[next].begin - 1);
    if (ended < ends_.size()) until = std::min(until, ends_[ended]);
    const std::size_t before = states.size();
    if (until >= window.first) add_state(states, vertex, from, until, {.present = present, .begun = begun});
    if (states.size() > before) begun = 0;  // else it lies between two ticks: a robot that waits on meets them as well
    from = until + 1;
  }
}

void Sipps::add_state(std::vector<State>& states, int vertex, Half first, Half last, Occupancy occupancy) {
  const Tick begin = (first + 1) / 2, end = last / 2;
  if (begin <= end) states.push_back({begin, end, vertex, occupancy, kForever, kForever, 0});
}

/// Departures at which the robot conflicts with others on `edge`; hard: sorted and united.
std::span<const Range> Sipps::departures_of(int edge) {
  const auto row = departures_.row(edge, [&](std::vector<Range>& departures) {
    ranges_.clear();
    const Tick duration = duration_[edge];
    for (const Near& near : traffic_.relations().row(roadmap_.vertex_count() + edge)) {
      for (const Visit& visit : traffic_.at(near.element)) {
        const Relation relation = near.relation(instance_.reach(robot_, visit.robot));
        if (relation == Relation::none) continue;
        Range range = departures_into(widened(visit.begin, visit.end, instance_.rules().k), duration);
        if (relation == Relation::ordered) {  // not the same order at both ends
          const Tick enter = visit.begin / 2, level = (visit.end + 1) / 2 - duration;
          range = {std::min(enter, level), std::max(enter, level)};
        }
        if (range.first <= range.last) ranges_.push_back(range);
      }
    }
    for (const std::int32_t resource : instance_.resources_of(roadmap_.vertex_count() + edge)) {
      traffic_.users().full_departures(robot_, resource, duration, ranges_);
    }
    if (!is_soft()) unite(ranges_);
    departures.insert(departures.end(), ranges_.begin(), ranges_.end());
  });
  return departures_.items(row);
}

void Sipps::expand(int label) {
  ++statistics_.low_level_expansions;
  const Label from = labels_[label];
  const State here = states_[from.state];
  if ((*distance_)(here.vertex) == 0) finish(label);
  const std::int32_t first = out_->first[here.vertex], last = out_->first[here.vertex + 1];
  for (const auto& [edge, head, duration] : std::span(out_->way).subspan(first, last - first)) {
    const Tick h = (*distance_)(head);
    if (h == kForever || from.arrival + duration + h > latest_) continue;
    const Row row = states_of(head);
    int to = row.first;
    while (to < row.last && states_[to].last < from.arrival + duration) ++to;
    for (; to < row.last && states_[to].first - duration <= here.last; ++to) follow(label, edge, to);
  }
  if (!is_soft()) return;
  const int next = from.state + 1;
  if (next < states_of(here.vertex).last) {
    reach(label, next, -1, states_[next].first, from.conflicts + states_[next].occupancy.begun);
  }
}

/// Cross `edge` into the interval `to`, as early as possible and, if that conflicts, as early as it does not.
void Sipps::follow(int label, int edge, int to) {
  const Label& from = labels_[label];
  const State &here = states_[from.state], &there = states_[to];
  const Tick duration = duration_[edge], last = std::min(here.last, there.last - duration);
  Tick departure = std::max(from.arrival, there.first - duration);
  int conflicts = from.conflicts + there.occupancy.present;
  if (traffic_.is_unit()) {
    // Who comes the other way leaves `there` when the robot leaves `here`: at a boundary of both intervals.
    if (departure == here.last && there.first == departure + 1) {
      if (!is_soft() && here.occupancy.after == there.occupancy.before) return;
      if (is_soft()) traffic_.swappers(here.vertex, there.vertex, departure, [&](int) { ++conflicts; });
    }
    return reach(label, to, edge, departure + 1, conflicts);
  }
  const std::span<const Range> ranges = departures_of(edge);
  if (is_soft()) {
    const auto met = [&](Tick tick) {
      return std::ranges::count_if(ranges, [&](const Range& it) { return it.first <= tick && tick <= it.last; });
    };
    const auto number = static_cast<int>(met(departure));
    reach(label, to, edge, departure + duration, conflicts + number);
    if (number == 0) return;
  }
  for (bool moved = true; moved;) {
    moved = false;
    for (const Range& range : ranges) {
      if (departure < range.first || departure > range.last) continue;
      departure = range.last + 1;
      moved = true;
    }
  }
  if (departure <= last) reach(label, to, edge, departure + duration, conflicts);
}

void Sipps::reach(int parent, int to, int edge, Tick arrival, int conflicts) {
  State& state = states_[to];
  if (arrival >= state.closed || (arrival >= state.arrival && conflicts >= state.conflicts)) return;
  const Tick h = (*distance_)(state.vertex);
  if (arrival + h > latest_) return;
  state.arrival = arrival;
  state.conflicts = conflicts;
  push({arrival, conflicts, to, parent, edge, false}, h);
}

/// The path may end here: hard if no robot comes any more, soft with a conflict for each that does.
void Sipps::finish(int label) {
  Label end = labels_[label];
  const State& state = states_[end.state];
  if (!instance_.rules().disappear_at_goal) {
    if (!is_soft() && state.last != kForever) return;
    const Row row = states_of(state.vertex);
    for (int later = end.state + 1; is_soft() && later < row.last; ++later) {
      end.conflicts += states_[later].occupancy.begun;
    }
  }
  end.final = true;
  push(end, 0);
}

void Sipps::push(const Label& label, Tick h) {
  ++statistics_.low_level_generated;
  const auto chance = static_cast<std::uint32_t>(random_() >> 60);
  const auto arrival = static_cast<std::uint32_t>(std::max(label.arrival + h, least_));
  open_.push_back({static_cast<std::uint64_t>(label.conflicts) << 32 | arrival,
                   static_cast<std::uint32_t>(h) << 4 | (label.final ? 0 : chance),
                   static_cast<std::int32_t>(labels_.size())});
  labels_.push_back(label);
  std::ranges::push_heap(open_, std::greater{});
}

void Sipps::trace(int label, Path& path) const {
  const Beginning& beginning = instance_.beginning(robot_);
  path.assign(beginning.occupied.begin(), beginning.occupied.end());
  const std::size_t known = path.size();
  for (int it = label; it >= 0; it = labels_[it].parent) {
    const Label& reached = labels_[it];
    if (reached.edge < 0) continue;
    const Tick depart = reached.arrival - duration_[reached.edge];
    path.push_back(at_vertex(states_[reached.state].vertex, reached.arrival, reached.arrival));
    path.push_back(on_edge(roadmap_.vertex_count() + reached.edge, depart, reached.arrival));
  }
  std::reverse(path.begin() + static_cast<std::ptrdiff_t>(known), path.end());
  for (std::size_t step = known - 1; step + 2 < path.size(); step += 2) path[step].end = path[step + 1].begin - 1;
  if (!instance_.rules().disappear_at_goal) path.back().end = kForeverHalf;
}

}  // namespace mrpbench::mapf::lns
