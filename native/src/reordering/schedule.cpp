#include "reordering/schedule.hpp"

#include <algorithm>
#include <limits>

namespace mrpbench::mapf {

Schedule::Schedule(const AlternativeGraph& graph, const Decisions& decisions, const ArcIndex& arcs, Limits& limits)
    : decisions_(decisions),
      arcs_(arcs),
      times_(graph, arcs, arcs.fixed(), limits),
      violated_(arcs.size()),
      violations_(2 * decisions.count()),
      side_(decisions.count(), kOpen),
      position_(decisions.count(), -1) {
  for (std::int32_t arc = 0; arc < arcs.first_fixed() && consistent(); ++arc) update_violation(arc);
}

Tick Schedule::begins(int decision) const {
  Tick least = std::numeric_limits<Tick>::max();
  for (std::int32_t arc = arcs_.begin({decision, 0}); arc < arcs_.end({decision, 1}); ++arc) {
    least = std::min(least, times_[arcs_[arc].before]);
  }
  return least;
}

std::int64_t Schedule::times_around(Choice choice) const {
  std::int64_t sum = 0;
  for (const Arc& arc : decisions_.arcs(choice)) sum += times_[arc.before] + times_[arc.after];
  return sum;
}

bool Schedule::decide(Choice choice) {
  const Mark mark = this->mark();
  const bool possible = make(choice);
  for (std::size_t k = mark.made; k < made_.size(); ++k) update_pending(made_[k].decision);
  if (possible) {
    for (const auto& change : times_.since(mark.changes)) update_violations(change.event);
  }
  return possible;
}

void Schedule::undo(const Mark& mark) {
  std::vector<std::int32_t> events, decisions;
  for (const auto& change : times_.since(mark.changes)) events.push_back(change.event);
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
    for (const auto& change : times_.since(mark.changes)) {
      const std::int32_t robot = times_.robot_at_goal(change.event);
      if (robot >= 0) later->push_back({robot, times_[change.event]});
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
    for (std::int32_t arc = arcs_.begin(next); arc < arcs_.end(next); ++arc) {
      if (!times_.add(arc)) return false;
    }
    for (const std::int32_t decision : decisions_.implied(next)) todo.push_back({decision, next.side});
  }
  return true;
}

void Schedule::take_back(const Mark& mark) {
  times_.undo(mark.changes);
  for (; made_.size() > mark.made; made_.pop_back()) {
    times_.hold(made_.back(), false);
    side_[made_.back().decision] = kOpen;
  }
}

void Schedule::update_violations(std::int32_t event) {
  for (const std::int32_t arc : arcs_.out(event)) update_violation(arc);
  for (const std::int32_t arc : arcs_.in(event)) update_violation(arc);
}

void Schedule::update_violation(std::int32_t arc) {
  if (arc >= arcs_.first_fixed()) return;
  const auto [before, after, lag] = arcs_[arc];
  const bool now = times_[before] + lag > times_[after];
  if (now == static_cast<bool>(violated_[arc])) return;
  violated_[arc] = now;
  const Choice choice = arcs_.choice_of(arc);
  violations_[choice.index()] += now ? 1 : -1;
  update_pending(choice.decision);
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
