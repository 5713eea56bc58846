#include "reordering/schedule.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace mrpbench::mapf {

namespace {

/// Indices of `arcs` sorted by `event_of(arc)`, and where those of each event begin.
template <class Key>
void sort_by_event(const std::vector<Arc>& arcs, int events, Key event_of, std::vector<std::int32_t>& sorted,
                   std::vector<std::int32_t>& begin) {
  begin.assign(events + 1, 0);
  sorted.resize(arcs.size());
  for (const Arc& arc : arcs) ++begin[event_of(arc) + 1];
  for (int event = 0; event < events; ++event) begin[event + 1] += begin[event];
  std::vector<std::int32_t> next = begin;
  for (std::size_t k = 0; k < arcs.size(); ++k) sorted[next[event_of(arcs[k])]++] = static_cast<std::int32_t>(k);
}

}  // namespace

Schedule::Schedule(const AlternativeGraph& graph, const Decisions& decisions, Limits& limits)
    : graph_(graph),
      decisions_(decisions),
      limits_(limits),
      violations_(2 * decisions.count()),
      goal_of_(graph.events(), -1),
      time_(earliest_times(graph.first, graph.duration, graph.fixed)),
      next_time_(graph.events()),
      side_(decisions.count(), kOpen),
      position_(decisions.count(), -1),
      consistent_(static_cast<int>(time_.size()) == graph.events()) {
  for (int decision = 0; decision < decisions.count(); ++decision) {
    for (const Side side : {Side{0}, Side{1}}) {
      arc_begin_.push_back(static_cast<std::int32_t>(arcs_.size()));
      for (const Arc& arc : decisions.arcs({decision, side})) {
        arcs_.push_back(arc);
        decision_of_.push_back(decision);
      }
    }
  }
  arc_begin_.push_back(static_cast<std::int32_t>(arcs_.size()));
  arcs_.insert(arcs_.end(), graph.fixed.begin(), graph.fixed.end());
  active_.resize(arcs_.size());
  std::fill(active_.begin() + static_cast<std::ptrdiff_t>(decision_of_.size()), active_.end(), 1);
  violated_.resize(arcs_.size());
  sort_by_event(arcs_, graph.events(), [](const Arc& arc) { return arc.before; }, out_, out_begin_);
  sort_by_event(arcs_, graph.events(), [](const Arc& arc) { return arc.after; }, in_, in_begin_);
  for (int robot = 0; robot < graph.robots(); ++robot) {
    last_.push_back(graph.first[robot + 1] - 1);
    goal_of_[last_.back()] = robot;
    if (consistent_) cost_ += time_[last_.back()];
  }
  if (!consistent_) return;
  for (std::int32_t event = 0; event < graph.events(); ++event) update_violations(event);
}

Tick Schedule::begins(int decision) const {
  Tick least = std::numeric_limits<Tick>::max();
  const std::int32_t end = arc_begin_[2 * decision + 2];
  for (std::int32_t arc = arc_begin_[2 * decision]; arc < end; ++arc) {
    least = std::min(least, time_[arcs_[arc].before]);
  }
  return least;
}

std::int64_t Schedule::times_around(Choice choice) const {
  std::int64_t sum = 0;
  for (const Arc& arc : decisions_.arcs(choice)) sum += time_[arc.before] + time_[arc.after];
  return sum;
}

bool Schedule::decide(Choice choice) {
  const Mark mark = this->mark();
  const bool possible = make(choice);
  for (std::size_t k = mark.made; k < made_.size(); ++k) update_pending(made_[k].decision);
  if (possible) {
    for (std::size_t k = mark.changes; k < changes_.size(); ++k) update_violations(changes_[k].event);
  }
  return possible;
}

void Schedule::undo(const Mark& mark) {
  std::vector<std::int32_t> events, decisions;
  for (std::size_t k = mark.changes; k < changes_.size(); ++k) events.push_back(changes_[k].event);
  for (std::size_t k = mark.made; k < made_.size(); ++k) decisions.push_back(made_[k].decision);
  take_back(mark);
  for (const std::int32_t event : events) update_violations(event);
  for (const std::int32_t decision : decisions) update_pending(decision);
}

std::optional<std::vector<Arrival>> Schedule::probe(Choice choice) {
  const Mark mark = this->mark();
  std::optional<std::vector<Arrival>> later;
  if (make(choice)) {
    later.emplace();
    for (std::size_t k = mark.changes; k < changes_.size(); ++k) {
      const std::int32_t event = changes_[k].event;
      if (goal_of_[event] >= 0) later->push_back({goal_of_[event], time_[event]});
    }
    std::ranges::sort(*later, {}, &Arrival::robot);
    const auto repeated = std::ranges::unique(*later, {}, &Arrival::robot);
    later->erase(repeated.begin(), repeated.end());
  }
  take_back(mark);
  return later;
}

bool Schedule::make(Choice choice) {
  std::vector<Choice> todo = {choice};
  while (!todo.empty()) {
    const Choice next = todo.back();
    todo.pop_back();
    if (side_[next.decision] == next.side) continue;
    if (side_[next.decision] != kOpen) return false;
    side_[next.decision] = next.side;
    made_.push_back(next);
    for (std::int32_t arc = arc_begin_[index(next)]; arc < arc_begin_[index(next) + 1]; ++arc) {
      if (!add(arc)) return false;
    }
    for (const std::int32_t decision : decisions_.implied(next)) todo.push_back({decision, next.side});
  }
  return true;
}

/// Let an arc hold from now on, and raise the times after it. False if it closes a cycle: then a raise of its end
/// comes round to its start. Times grow along all arcs, so each event is raised once if those with the least time
/// come first.
bool Schedule::add(std::int32_t arc) {
  active_[arc] = true;
  const auto [before, after, lag] = arcs_[arc];
  push(after, time_[before] + lag);
  bool possible = true;
  while (!heap_.empty()) {
    limits_.check();
    std::ranges::pop_heap(heap_, std::greater{});
    const std::int32_t event = heap_.back().event;
    heap_.pop_back();
    const Tick time = next_time_[event];
    next_time_[event] = 0;
    possible &= event != before;
    if (!possible) continue;  // empties the heap
    set(event, time);
    if (goal_of_[event] < 0) push(event + 1, time + graph_.duration[event]);
    for (std::int32_t k = out_begin_[event]; k < out_begin_[event + 1]; ++k) {
      if (active_[out_[k]]) push(arcs_[out_[k]].after, time + arcs_[out_[k]].lag);
    }
  }
  return possible;
}

void Schedule::push(std::int32_t event, Tick time) {
  if (time <= time_[event]) return;
  if (next_time_[event] == 0) {
    heap_.push_back({time_[event], event});
    std::ranges::push_heap(heap_, std::greater{});
  }
  next_time_[event] = std::max(next_time_[event], time);
}

void Schedule::set(std::int32_t event, Tick time) {
  changes_.push_back({event, time_[event]});
  if (goal_of_[event] >= 0) cost_ += time - time_[event];
  time_[event] = time;
}

void Schedule::take_back(const Mark& mark) {
  for (; changes_.size() > mark.changes; changes_.pop_back()) {
    const auto [event, before] = changes_.back();
    if (goal_of_[event] >= 0) cost_ += before - time_[event];
    time_[event] = before;
  }
  for (; made_.size() > mark.made; made_.pop_back()) {
    const std::size_t choice = index(made_.back());
    std::fill(active_.begin() + arc_begin_[choice], active_.begin() + arc_begin_[choice + 1], 0);
    side_[made_.back().decision] = kOpen;
  }
}

void Schedule::update_violations(std::int32_t event) {
  for (std::int32_t k = out_begin_[event]; k < out_begin_[event + 1]; ++k) update_violation(out_[k]);
  for (std::int32_t k = in_begin_[event]; k < in_begin_[event + 1]; ++k) update_violation(in_[k]);
}

void Schedule::update_violation(std::int32_t arc) {
  if (arc >= static_cast<std::int32_t>(decision_of_.size())) return;
  const auto [before, after, lag] = arcs_[arc];
  const bool now = time_[before] + lag > time_[after];
  if (now == static_cast<bool>(violated_[arc])) return;
  violated_[arc] = now;
  const std::int32_t decision = decision_of_[arc];
  violations_[2 * decision + (arc >= arc_begin_[2 * decision + 1])] += now ? 1 : -1;
  update_pending(decision);
}

void Schedule::update_pending(std::int32_t decision) {
  const bool now = is_open(decision) && !holds({decision, 0}) && !holds({decision, 1});
  if (now == (position_[decision] >= 0)) return;
  if (now) {
    position_[decision] = static_cast<std::int32_t>(pending_.size());
    pending_.push_back(decision);
  } else {
    const std::int32_t moved = pending_.back();
    position_[moved] = position_[decision];
    pending_[position_[decision]] = moved;
    pending_.pop_back();
    position_[decision] = -1;
  }
}

}  // namespace mrpbench::mapf
