#include "reordering/local_search.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace mrpbench::mapf {

LocalSearch::LocalSearch(const AlternativeGraph& graph, const Decisions& decisions, const ArcIndex& arcs,
                         std::vector<Side> sides, Limits& limits)
    : decisions_(decisions),
      arcs_(arcs),
      times_(graph, arcs, arcs.holding(sides), limits),
      sides_(std::move(sides)),
      cost_(times_.cost()),
      round_of_(sides_.size()) {}

void LocalSearch::run(std::int64_t work) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const Wait& wait : waits()) {
      if (times_.work() >= work) return;
      changed |= improves(wait.decision);
    }
  }
}

/// Decisions that robots wait for, the longest waits first.
std::vector<LocalSearch::Wait> LocalSearch::waits() const {
  std::vector<Wait> found;
  for (std::int32_t decision = 0; decision < decisions_.count(); ++decision) {
    const Tick ticks = longest_wait({decision, sides_[decision]});
    if (ticks > 0) found.push_back({ticks, decision});
  }
  std::ranges::stable_sort(found, std::greater{}, &Wait::ticks);
  return found;
}

/// The longest time for which a robot waits because of a choice, and of nothing else.
Tick LocalSearch::longest_wait(Choice choice) const {
  Tick most = 0;
  for (const auto [before, after, lag] : decisions_.arcs(choice)) {
    if (times_[after] > times_[before] + lag) continue;
    most = std::max(most, times_[after] - times_.without_waiting(after));
  }
  return most;
}

/// Switch a decision if robots then arrive earlier in sum.
bool LocalSearch::improves(std::int32_t decision) {
  const Choice choice{decision, sides_[decision]};
  if (longest_wait(choice) == 0) return false;
  ++round_;
  chosen_ = {choice.other()};
  round_of_[decision] = round_;
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    for (const std::int32_t other : decisions_.implied(chosen_[k])) {
      if (sides_[other] == chosen_[k].side || round_of_[other] == round_) continue;
      round_of_[other] = round_;
      chosen_.push_back({other, chosen_[k].side});
    }
  }
  const bool better = switched();
  for (const Choice& it : chosen_) {
    if (better) {
      sides_[it.decision] = it.side;
    } else {
      times_.hold(it, false);
      times_.hold(it.other(), true);
    }
  }
  if (better) {
    times_.keep();
    cost_ = times_.cost();
  } else {
    times_.undo(0);
  }
  return better;
}

/// Let the chosen choices hold; tell whether robots arrive earlier in sum.
bool LocalSearch::switched() {
  for (const Choice& it : chosen_) times_.remove(it.other());
  for (const Choice& it : chosen_) {
    for (std::int32_t arc = arcs_.begin(it); arc < arcs_.end(it); ++arc) {
      if (times_.cost() >= cost_ || !times_.add(arc)) return false;
    }
  }
  return times_.cost() < cost_;
}

}  // namespace mrpbench::mapf
