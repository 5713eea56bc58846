#include "mrpbench_mapf/cbs/tree/focal_list.hpp"

#include <algorithm>
#include <limits>

namespace mrpbench::mapf {

void OnlineErrors::observe(const Candidate& node, const Candidate& better_child) {
  const double cost_error = static_cast<double>(better_child.cost - node.cost);
  const double distance_error = better_child.conflicts - (node.conflicts - 1);
  ++observed_;
  cost_error_ += (cost_error - cost_error_) / static_cast<double>(observed_);
  distance_error_ += (distance_error - distance_error_) / static_cast<double>(observed_);
  // Every conflict takes 1 / (1 - distance_error) steps; with an error of one or more the conflicts never end.
  constexpr double kMostSteps = 100.0;
  const double steps = distance_error_ < 1.0 ? std::min(kMostSteps, 1.0 / (1.0 - distance_error_)) : kMostSteps;
  per_conflict_ = std::max(0.0, cost_error_) * steps;
}

void FocalList::clear() {
  entries_.clear();
  by_least_.clear();
  by_estimate_.clear();
  focal_.clear();
}

void FocalList::push(const Candidate& node) {
  insert(node, selection_ == Selection::focal ? static_cast<double>(node.cost) : errors_.estimate(node));
}

/// The root waits until nothing else is within the bound: any assignment that is cheap enough will do.
void FocalList::push_root(std::int32_t id, Cost cost, std::int32_t /*conflicts*/) {
  constexpr std::int32_t kLast = 1 << 30;
  insert({id, cost, 0, cost, kLast}, static_cast<double>(cost));
}

void FocalList::insert(const Candidate& node, double estimate) {
  if (static_cast<std::size_t>(node.id) >= entries_.size()) entries_.resize(node.id + 1);
  entries_[node.id] = {node, estimate};
  by_least_.insert({node.least, node.conflicts, -node.id});
  by_estimate_.insert({estimate, node.conflicts, -node.id});
  if (estimate <= bound_) focal_.insert({node.conflicts, estimate, -node.id});
  constexpr std::size_t kNodeBytes = 300;  // of a node in the sets
  limits_.charge_growth(counted_, entries_.size() * kNodeBytes);
}

void FocalList::learn(const Candidate& node, std::span<const Candidate> children) {
  const auto best = std::ranges::min_element(children, {}, [&](const Candidate& it) { return errors_.estimate(it); });
  if (best != children.end()) errors_.observe(node, *best);
}

void FocalList::update_focal() {
  const double first =
      selection_ == Selection::focal ? static_cast<double>(least()) : std::get<0>(*by_estimate_.begin());
  const double bound = w_ * first;
  const auto beyond = [&](double estimate) {
    return by_estimate_.upper_bound({estimate, std::numeric_limits<std::int32_t>::max(), 0});
  };
  const auto [low, high] = std::minmax(bound, bound_);
  for (auto it = beyond(low), end = beyond(high); it != end; ++it) {
    const auto [estimate, conflicts, id] = *it;
    if (bound > bound_) {
      focal_.insert({conflicts, estimate, id});
    } else {
      focal_.erase({conflicts, estimate, id});
    }
  }
  bound_ = bound;
}

std::int32_t FocalList::choose() {
  to_raise_ = false;
  const std::int32_t fewest = -std::get<2>(*focal_.begin());
  if (selection_ == Selection::focal || affordable(fewest)) return fewest;
  const std::int32_t likely = -std::get<2>(*by_estimate_.begin());
  if (affordable(likely)) return likely;
  to_raise_ = true;
  return -std::get<2>(*by_least_.begin());
}

std::int32_t FocalList::pop() {
  update_focal();
  const std::int32_t id = choose();
  const auto& [node, estimate] = entries_[id];
  by_least_.erase({node.least, node.conflicts, -id});
  by_estimate_.erase({estimate, node.conflicts, -id});
  focal_.erase({node.conflicts, estimate, -id});
  return id;
}

}  // namespace mrpbench::mapf
