#include "mrpbench_mapf/sipp.hpp"

#include <algorithm>
#include <functional>

namespace mrpbench::mapf {

Sipp::Sipp(const Instance& instance, Limits& limits, Statistics& statistics)
    : instance_(instance), roadmap_(instance.roadmap()), limits_(limits), statistics_(statistics) {
  limits.charge(static_cast<std::size_t>(roadmap_.element_count()) * sizeof(Slot));
  vertex_slot_.resize(roadmap_.vertex_count());
  edge_slot_.resize(roadmap_.edge_count());
}

bool Sipp::search(int robot, DistanceTable& distance, const Obstacles& obstacles, Path& path,
                  const Reservations* others, Tick delay) {
  const Beginning& beginning = instance_.beginning(robot);
  distance_ = &distance;
  begin(robot, obstacles, others);
  least_cost_ = earliest_stay(instance_.robots()[robot]);
  if (least_cost_ == kForever || distance(beginning.vertex) == kForever) return false;

  const Slot slot = states_of(beginning.vertex);
  for (int state = slot.first; state < slot.first + slot.count; ++state) {
    if (states_[state].first > beginning.free_at || states_[state].last < beginning.free_at) continue;
    states_[state].arrival = std::min(states_[state].last, beginning.free_at + delay);
    push(state);
  }
  bool found = false;
  while (!open_.empty() && !found) {
    limits_.check();
    std::ranges::pop_heap(open_, std::greater{});
    const Open best = open_.back();
    open_.pop_back();
    if (states_[best.state].closed) continue;  // a better entry for it came first
    states_[best.state].closed = true;
    found = is_final(best.state, best.h);
    if (found) {
      trace(best.state, path);
    } else {
      expand(best.state);
    }
  }
  limits_.charge_growth(counted_, states_.capacity() * sizeof(State) + open_.capacity() * sizeof(Open) +
                                      departures_.capacity() * sizeof(Range));
  return found;
}

void Sipp::begin(int robot, const Obstacles& obstacles, const Reservations* others) {
  robot_ = robot;
  obstacles_ = &obstacles;
  others_ = others;
  duration_ = roadmap_.duration(instance_.robots()[robot].profile);
  if (++epoch_ == 0) {  // wrapped round: old stamps would look new
    std::ranges::fill(vertex_slot_, Slot{});
    std::ranges::fill(edge_slot_, Slot{});
    epoch_ = 1;
  }
  states_.clear();
  departures_.clear();
  open_.clear();
}

/// Earliest tick from which some goal is free for good: no robot that stays there can arrive before.
Tick Sipp::earliest_stay(const Robot& robot) {
  if (instance_.rules().disappear_at_goal) return 0;
  Tick earliest = kForever;
  for (const int goal : robot.goals) {
    const Slot slot = states_of(goal);
    if (slot.count == 0) continue;
    const State& last = states_[slot.first + slot.count - 1];
    if (last.last == kForever) earliest = std::min(earliest, last.first);
  }
  return earliest;
}

/// The states of a vertex, made when it is first touched: the gaps between the blocked half-ticks that hold a tick.
Sipp::Slot Sipp::states_of(int vertex) {
  Slot& slot = vertex_slot_[vertex];
  if (slot.epoch == epoch_) return slot;
  slot = {epoch_, static_cast<std::int32_t>(states_.size()), 0};
  scratch_.clear();
  obstacles_->at_vertex(vertex, scratch_);
  unite(scratch_);
  const auto add = [&](Half first, Half last) {
    const Tick begin = (first + 1) / 2, end = last / 2;
    if (first <= last && begin <= end) states_.push_back({begin, end, kForever, vertex, -1, -1, 0, false});
  };
  Half free = 0;
  for (const Range& blocked : scratch_) {
    add(free, blocked.first - 1);
    free = blocked.last + 1;
  }
  if (free <= kForeverHalf) add(free, kForeverHalf);
  slot.count = static_cast<std::int32_t>(states_.size()) - slot.first;
  return slot;
}

/// The first tick from `departure` on at which the robot may enter `edge`.
Tick Sipp::next_departure(int edge, Tick departure) {
  Slot& slot = edge_slot_[edge];
  if (slot.epoch != epoch_) {
    scratch_.clear();
    obstacles_->on_edge(edge, duration_[edge], scratch_);
    unite(scratch_);
    slot = {epoch_, static_cast<std::int32_t>(departures_.size()), static_cast<std::int32_t>(scratch_.size())};
    departures_.insert(departures_.end(), scratch_.begin(), scratch_.end());
  }
  if (slot.count == 0) return departure;
  const auto begin = departures_.begin() + slot.first, end = begin + slot.count;
  const auto next = std::partition_point(begin, end, [&](const Range& range) { return range.last < departure; });
  return next == end || next->first > departure ? departure : next->last + 1;
}

void Sipp::expand(int state) {
  ++statistics_.low_level_expansions;
  const State from = states_[state];
  for (const int edge : roadmap_.out(from.vertex)) {
    const Tick duration = duration_[edge];
    if (duration < 0 || (*distance_)(roadmap_.head(edge)) == kForever) continue;
    const Slot slot = states_of(roadmap_.head(edge));
    for (int to = slot.first; to < slot.first + slot.count; ++to) {
      const Tick safe_from = states_[to].first - duration, safe_until = states_[to].last - duration;
      Tick departure = std::max(from.arrival, safe_from);
      if (safe_from > from.last) break;
      if (departure > safe_until || departure + duration > states_[to].arrival || states_[to].closed) continue;
      departure = next_departure(edge, departure);
      if (departure > from.last || departure > safe_until || departure + duration > states_[to].arrival) continue;
      State reached = states_[to];
      const bool earlier = departure + duration < reached.arrival;
      reached.arrival = departure + duration;
      reached.parent = state;
      reached.edge = edge;
      reached.conflicts = from.conflicts + count_conflicts(from, edge, departure, reached);
      if (!earlier && reached.conflicts >= states_[to].conflicts) continue;
      states_[to] = reached;
      push(to);
    }
  }
}

/// Conflicts with the others while waiting at `from`, crossing `edge`, and standing at `to`.
int Sipp::count_conflicts(const State& from, int edge, Tick departure, const State& to) const {
  if (others_ == nullptr) return 0;
  const int element = roadmap_.vertex_count() + edge;
  int number = others_->count(robot_, on_edge(element, departure, to.arrival));
  if (departure > from.arrival) number += others_->count(robot_, {from.vertex, 2 * from.arrival + 1, 2 * departure});
  const bool parks = !instance_.rules().disappear_at_goal && to.last == kForever && (*distance_)(to.vertex) == 0;
  return number + others_->count(robot_, at_vertex(to.vertex, to.arrival, parks ? kForever : to.arrival));
}

void Sipp::push(int state) {
  ++statistics_.low_level_generated;
  const Tick h = (*distance_)(states_[state].vertex);
  const Tick arrival = states_[state].arrival;
  open_.push_back({std::max(arrival + h, least_cost_), h, states_[state].conflicts, state});
  std::ranges::push_heap(open_, std::greater{});
}

void Sipp::trace(int state, Path& path) const {
  const Beginning& beginning = instance_.beginning(robot_);
  path.assign(beginning.occupied.begin(), beginning.occupied.end());
  std::size_t moves = 0;
  for (int s = state; states_[s].parent >= 0; s = states_[s].parent) ++moves;
  std::size_t step = path.size() + 2 * moves;
  path.resize(step);
  for (int s = state; states_[s].parent >= 0; s = states_[s].parent) {
    const Tick arrive = states_[s].arrival, depart = arrive - duration_[states_[s].edge];
    path[--step] = at_vertex(states_[s].vertex, arrive, arrive);
    path[--step] = on_edge(roadmap_.vertex_count() + states_[s].edge, depart, arrive);
  }
  for (step = beginning.occupied.size() - 1; step + 2 < path.size(); step += 2) {
    path[step].end = path[step + 1].begin - 1;
  }
  if (!instance_.rules().disappear_at_goal) path.back().end = kForeverHalf;
}

}  // namespace mrpbench::mapf
