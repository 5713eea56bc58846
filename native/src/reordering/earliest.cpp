#include "reordering/earliest.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace mrpbench::mapf {

namespace {

std::vector<Tick> times_under(const AlternativeGraph& graph, const ArcIndex& arcs, const std::vector<char>& holds) {
  std::vector<Arc> held;
  for (std::int32_t arc = 0; arc < arcs.size(); ++arc) {
    if (holds[arc]) held.push_back(arcs[arc]);
  }
  return earliest_times(graph.first, graph.duration, held);
}

}  // namespace

EarliestTimes::EarliestTimes(const AlternativeGraph& graph, const ArcIndex& arcs, std::vector<char> holds,
                             Limits& limits)
    : graph_(graph),
      arcs_(arcs),
      limits_(limits),
      holds_(std::move(holds)),
      is_first_(graph.events()),
      goal_of_(graph.events(), -1),
      time_(times_under(graph, arcs, holds_)),
      next_time_(graph.events()),
      consistent_(static_cast<int>(time_.size()) == graph.events()) {
  for (int robot = 0; robot < graph.robots(); ++robot) {
    is_first_[graph.first[robot]] = true;
    goal_of_[graph.first[robot + 1] - 1] = robot;
    if (consistent_) cost_ += arrival(robot);
  }
}

/// If the arc closes a cycle, a raise of its end comes round to its start. Times grow along all arcs, so each event is
/// raised once if those with the least time come first.
bool EarliestTimes::add(std::int32_t arc) {
  holds_[arc] = true;
  const auto [before, after, lag] = arcs_[arc];
  raise(after, time_[before] + lag);
  bool possible = true;
  while (!heap_.empty()) {
    const std::int32_t event = next();
    const Tick time = std::exchange(next_time_[event], 0);
    possible &= event != before;
    if (!possible) continue;  // empties the heap
    set(event, time);
    if (goal_of_[event] < 0) raise(event + 1, time + graph_.duration[event]);
    for (const std::int32_t out : arcs_.out(event)) {
      if (holds_[out]) raise(arcs_[out].after, time + arcs_[out].lag);
    }
  }
  return possible;
}

/// Only what an event waited for lets it be earlier. Those with the least time come first, as in `add`.
void EarliestTimes::remove(Choice choice) {
  hold(choice, false);
  const auto fall = [&](std::int32_t after, Tick earlier) {
    if (time_[after] == earlier && next_time_[after] == 0) {
      next_time_[after] = 1;
      wait(after);
    }
  };
  for (std::int32_t arc = arcs_.begin(choice); arc < arcs_.end(choice); ++arc) {
    fall(arcs_[arc].after, time_[arcs_[arc].before] + arcs_[arc].lag);
  }
  while (!heap_.empty()) {
    const std::int32_t event = next();
    next_time_[event] = 0;
    const Tick before = time_[event], now = earliest(event);
    if (now == before) continue;
    set(event, now);
    if (goal_of_[event] < 0) fall(event + 1, before + graph_.duration[event]);
    for (const std::int32_t out : arcs_.out(event)) {
      if (holds_[out]) fall(arcs_[out].after, before + arcs_[out].lag);
    }
  }
}

void EarliestTimes::undo(std::size_t count) {
  for (; changes_.size() > count; changes_.pop_back()) {
    const auto [event, before] = changes_.back();
    if (goal_of_[event] >= 0) cost_ += before - time_[event];
    time_[event] = before;
  }
}

void EarliestTimes::hold(Choice choice, bool now) {
  std::fill(holds_.begin() + arcs_.begin(choice), holds_.begin() + arcs_.end(choice), now);
}

void EarliestTimes::raise(std::int32_t event, Tick time) {
  if (time <= time_[event]) return;
  if (next_time_[event] == 0) wait(event);
  next_time_[event] = std::max(next_time_[event], time);
}

void EarliestTimes::wait(std::int32_t event) {
  heap_.push_back({time_[event], event});
  std::ranges::push_heap(heap_, std::greater{});
}

std::int32_t EarliestTimes::next() {
  limits_.check();
  std::ranges::pop_heap(heap_, std::greater{});
  const std::int32_t event = heap_.back().event;
  heap_.pop_back();
  return event;
}

void EarliestTimes::set(std::int32_t event, Tick time) {
  ++work_;
  changes_.push_back({event, time_[event]});
  if (goal_of_[event] >= 0) cost_ += time - time_[event];
  time_[event] = time;
}

Tick EarliestTimes::earliest(std::int32_t event) const {
  Tick time = without_waiting(event);
  for (const std::int32_t in : arcs_.in(event)) {
    if (holds_[in]) time = std::max(time, time_[arcs_[in].before] + arcs_[in].lag);
  }
  return time;
}

}  // namespace mrpbench::mapf
