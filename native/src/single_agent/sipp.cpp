#include "mrpbench_mapf/single_agent/sipp.hpp"

#include <algorithm>
#include <functional>

namespace mrpbench::mapf {

namespace {

/// Vertices, once for each number of goals that a robot may have visited.
int places(const Instance& instance) {
  std::size_t most = 0;
  for (const Robot& robot : instance.robots()) most = std::max(most, robot.via.size());
  return instance.roadmap().vertex_count() * static_cast<int>(most + 1);
}

}  // namespace

Sipp::Sipp(const Instance& instance, Limits& limits, Statistics& statistics)
    : instance_(instance),
      roadmap_(instance.roadmap()),
      limits_(limits),
      statistics_(statistics),
      states_(places(instance), limits),
      departures_(roadmap_.edge_count(), limits) {}

bool Sipp::search(int robot, const DistanceTables& tables, const Obstacles& obstacles, Path& path,
                  const Reservations* others, Tick delay) {
  const Beginning& beginning = instance_.beginning(robot);
  remaining_ = &tables.remaining(robot);
  begin(robot, obstacles, others);
  least_cost_ = earliest_stay(instance_.robots()[robot]);
  if (least_cost_ == kForever || to_go(beginning.vertex, 0) == kForever) return false;

  const Row row = states_of(beginning.vertex, 0);
  for (int state = row.first; state < row.last; ++state) {
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
  limits_.charge_growth(counted_, open_.capacity() * sizeof(Open));
  return found;
}

void Sipp::begin(int robot, const Obstacles& obstacles, const Reservations* others) {
  robot_ = robot;
  obstacles_ = &obstacles;
  others_ = others;
  duration_ = roadmap_.duration(instance_.robots()[robot].profile);
  states_.forget();
  departures_.forget();
  open_.clear();
}

/// Earliest tick from which some goal is free for good: no robot that stays there can arrive before.
Tick Sipp::earliest_stay(const Robot& robot) {
  if (instance_.rules().disappear_at_goal) return 0;
  Tick earliest = kForever;
  for (const int goal : robot.goals) {
    const Row row = states_of(goal, static_cast<int>(remaining_->size()) - 1);
    if (row.size() == 0) continue;
    const State& last = states_[row.last - 1];
    if (last.last == kForever) earliest = std::min(earliest, last.first);
  }
  return earliest;
}

/// The states of a vertex, made when it is first touched: the gaps between the blocked half-ticks that hold a tick.
Sipp::Row Sipp::states_of(int vertex, int visited) {
  return states_.row(visited * roadmap_.vertex_count() + vertex, [&](std::vector<State>& states) {
    scratch_.clear();
    obstacles_->at_vertex(vertex, scratch_);
    unite(scratch_);
    const auto add = [&](Half first, Half last) {
      const Tick begin = (first + 1) / 2, end = last / 2;
      if (first <= last && begin <= end)
        states.push_back({begin, end, kForever, vertex, -1, -1, 0, static_cast<std::int16_t>(visited), false});
    };
    Half free = 0;
    for (const Range& blocked : scratch_) {
      add(free, blocked.first - 1);
      free = blocked.last + 1;
    }
    if (free <= kForeverHalf) add(free, kForeverHalf);
  });
}

/// How many goals the robot has visited once it is at `vertex`.
int Sipp::visited_at(int vertex, int visited) const {
  const int before = instance_.beginning(robot_).visited;
  return mapf::visited_at(vertex, instance_.robots()[robot_].via, before + visited) - before;
}

/// The first tick from `departure` on at which the robot may enter `edge`.
Tick Sipp::next_departure(int edge, Tick departure) {
  const auto row = departures_.row(edge, [&](std::vector<Range>& departures) {
    scratch_.clear();
    obstacles_->on_edge(edge, duration_[edge], scratch_);
    unite(scratch_);
    departures.insert(departures.end(), scratch_.begin(), scratch_.end());
  });
  if (row.size() == 0) return departure;
  const std::span<const Range> blocked = departures_.items(row);
  const auto next = std::ranges::partition_point(blocked, [&](const Range& it) { return it.last < departure; });
  return next == blocked.end() || next->first > departure ? departure : next->last + 1;
}

void Sipp::expand(int state) {
  ++statistics_.low_level_expansions;
  const State from = states_[state];
  for (const int edge : roadmap_.out(from.vertex)) {
    const Tick duration = duration_[edge];
    const int head = roadmap_.head(edge);
    if (duration < 0 || to_go(head, from.visited) == kForever) continue;
    const Row row = states_of(head, visited_at(head, from.visited));
    for (int to = row.first; to < row.last; ++to) {
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
int Sipp::count_conflicts(const State& from, int edge, Tick departure, const State& to) {
  if (others_ == nullptr) return 0;
  const int element = roadmap_.vertex_count() + edge;
  int number = others_->count(robot_, on_edge(element, departure, to.arrival));
  if (departure > from.arrival) number += others_->count(robot_, {from.vertex, 2 * from.arrival + 1, 2 * departure});
  const bool parks = !instance_.rules().disappear_at_goal && to.last == kForever && to_go(to.vertex, to.visited) == 0;
  return number + others_->count(robot_, at_vertex(to.vertex, to.arrival, parks ? kForever : to.arrival));
}

void Sipp::push(int state) {
  ++statistics_.low_level_generated;
  const Tick h = to_go(states_[state].vertex, states_[state].visited);
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
