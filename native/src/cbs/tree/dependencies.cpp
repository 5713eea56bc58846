#include "mrpbench_mapf/cbs/tree/dependencies.hpp"

#include <algorithm>

namespace mrpbench::mapf {

Cost Dependencies::evaluate(const NodeState& state, std::span<const Conflict* const> conflicts) {
  ++spare_;
  pairs_.clear();
  for (const Conflict* it : conflicts) pairs_.push_back(std::minmax(it->one, it->other));
  std::ranges::sort(pairs_);
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  number_.assign(context_.space.instance().size(), -1);
  edges_.clear();
  std::int32_t vertices = 0;
  for (const auto& [one, other] : pairs_) {
    const std::int32_t together = least_cost(state, one, other);
    if (together == kImpossible) return kImpossible;
    const std::int32_t weight = together - state.least(one) - state.least(other);
    if (weight <= 0) continue;
    for (const int robot : {one, other}) {
      if (number_[robot] < 0) number_[robot] = vertices++;
    }
    edges_.push_back({number_[one], number_[other], weight});
  }
  return minimum_cover(vertices, edges_, context_.limits);
}

/// What two robots cost at least together.
std::int32_t Dependencies::least_cost(const NodeState& state, int one, int other) {
  const Name name{one, other, state.key(one), state.key(other)};
  const auto place = known_.find(name);
  if (place != known_.end()) return place->second;
  const std::int32_t cost = solve(state, one, other);
  known_.emplace(name, cost);
  context_.limits.charge_growth(counted_, known_.size() * (sizeof(Name) + 32));
  return cost;
}

std::int32_t Dependencies::solve(const NodeState& state, int one, int other) {
  pair_.start(state, one, other);
  const std::int64_t before = expansions();
  const std::int64_t most = before + std::clamp<std::int64_t>(spare_, 1, context_.options.pair_expansions);
  for (;;) {
    if (!pair_.next()) return kImpossible;
    if (pair_.is_solved() || expansions() >= most) break;
    pair_.expand();
  }
  const auto cost = static_cast<std::int32_t>(pair_.lower_bound());
  if (!pair_.is_solved()) {
    // To raise its bound by so much, a tree branches about 2^raised times.
    const std::int32_t raised = std::clamp(cost - state.least(one) - state.least(other), 0, 16);
    spare_ -= std::clamp<std::int64_t>(expansions() - before - (1 << raised), 0, spare_);
  }
  return cost;
}

}  // namespace mrpbench::mapf
