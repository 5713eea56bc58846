#include "reordering/local_search.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace mrpbench::mapf {

LocalSearch::LocalSearch(const AlternativeGraph& graph, const Decisions& decisions, const ArcIndex& arcs,
                         std::vector<Side> sides, Limits& limits)
    : graph_(graph),
      decisions_(decisions),
      arcs_(arcs),
      times_(graph, arcs, arcs.holding(sides), limits),
      sides_(std::move(sides)),
      round_of_(sides_.size()) {}

std::int64_t LocalSearch::run(std::int64_t work) {
  for (bool changed = true; changed && times_.work() < work;) {
    changed = false;
    for (const Wait& wait : waits()) {
      if (times_.work() >= work) break;
      changed |= improves(wait.decision);
    }
  }
  return times_.work();
}

/// Decisions that robots wait for, the longest waits first.
std::vector<LocalSearch::Wait> LocalSearch::waits() const {
  std::vector<Wait> found;
  for (std::int32_t decision = 0; decision < decisions_.count(); ++decision) {
    const Choice choice{decision, sides_[decision]};
    Tick most = 0;
    for (std::int32_t arc = arcs_.begin(choice); arc < arcs_.end(choice); ++arc) most = std::max(most, waiting(arc));
    if (most > 0) found.push_back({most, decision});
  }
  std::ranges::stable_sort(found, std::greater{}, &Wait::ticks);
  return found;
}

/// Time for which the robot of the later event waits for the earlier one; 0 if something else holds it up.
Tick LocalSearch::waiting(std::int32_t arc) const {
  const auto [before, after, lag] = arcs_[arc];
  if (times_[after] > times_[before] + lag) return 0;
  return times_[after] - (times_.is_first(after) ? 0 : times_[after - 1] + graph_.duration[after - 1]);
}

/// Switch a decision if robots then arrive earlier in sum.
bool LocalSearch::improves(std::int32_t decision) {
  const Choice choice{decision, sides_[decision]};
  bool waits = false;
  for (std::int32_t arc = arcs_.begin(choice); arc < arcs_.end(choice); ++arc) waits |= waiting(arc) > 0;
  if (!waits) return false;
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
  if (!better) times_.undo(0);
  times_.forget_changes();
  return better;
}

/// Let the chosen choices hold; tell whether robots arrive earlier in sum.
bool LocalSearch::switched() {
  const Cost before = times_.cost();
  for (const Choice& it : chosen_) times_.remove(it.other());
  for (const Choice& it : chosen_) {
    for (std::int32_t arc = arcs_.begin(it); arc < arcs_.end(it); ++arc) {
      if (times_.cost() >= before || !times_.add(arc)) return false;
    }
  }
  return times_.cost() < before;
}

}  // namespace mrpbench::mapf
