#include <numeric>

#include "mrpbench_mapf/bounded/bounded_tree.hpp"

namespace mrpbench::mapf {

void BoundedTree::start() {
  const GoalChoice goals = options_.techniques.goals;
  if (goals == GoalChoice::ranked) {
    ranked_.emplace(find_candidates(bench_), limits_);
    return announce_root();
  }
  if (goals == GoalChoice::by_node && !assignment_.emplace(find_candidates(bench_), limits_).solve()) return;
  const std::vector<int> any(robots_, TimedPath::kAnyGoal);
  if (!make_root(any)) result_.statistics.failed_robot = failed_;
  root_effort_ = result_.statistics.low_level_expansions;
}

/// Put into the queue a node without constraints in which robots go to `goals`. False if one cannot.
bool BoundedTree::make_root(std::span<const int> goals) {
  Child root;
  situation_.clear_constraints();
  for (int robot = 0; robot < robots_; ++robot) replace({robot, 0, {}});
  before_.clear();
  pending_.resize(robots_);
  std::iota(pending_.begin(), pending_.end(), 0);
  root_goals_ = goals;
  if (!replan(root)) return false;
  push(nullptr, root);
  if (ranked_) ++result_.statistics.assignments;
  return true;
}

void BoundedTree::make_ranked_root() {
  const RankedGoals::Ranked ranked = *std::move(next_root_);
  make_root(ranked.goals);
  announce_root();
}

/// Let the next root wait until nothing else is within the bound: any assignment that is cheap enough will do.
void BoundedTree::announce_root() {
  constexpr std::int32_t kLast = 1 << 30;  // conflicts
  next_root_ = ranked_->next();
  if (!next_root_) return;
  by_id_.push_back(nullptr);
  const auto id = static_cast<std::int32_t>(by_id_.size()) - 1;
  queue_.push({id, next_root_->cost, next_root_->cost, kLast}, static_cast<double>(next_root_->cost));
}

}  // namespace mrpbench::mapf
