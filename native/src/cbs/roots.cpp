#include <numeric>

#include "mrpbench_mapf/cbs/constraint_tree.hpp"

namespace mrpbench::mapf {

std::optional<int> ConstraintTree::start() {
  clear();
  const std::vector<int> any(bench_.space.instance().size(), TimedPath::kAnyGoal);
  Node* root = make_root(any);
  if (root == nullptr) return failed_;
  push(*root);
  return std::nullopt;
}

void ConstraintTree::start(RankedGoals& ranked) {
  clear();
  ranked_ = &ranked;
  announce_root(0);
}

bool ConstraintTree::start(NodeAssignment& assignment) {
  clear();
  if (!assignment.solve()) return false;
  assignment_ = &assignment;
  Node* root = make_root({});
  if (root != nullptr) push(*root);
  return root != nullptr;
}

/// A node without constraints in which robots go to `goals`, null if one cannot. Robots that go where they did in the
/// last ranked root do so by the same paths.
ConstraintTree::Node* ConstraintTree::make_root(std::span<const int> goals) {
  situation_.clear_constraints();
  for (const int robot : robots_) others_.remove(robot);
  robots_.resize(bench_.space.instance().size());
  std::iota(robots_.begin(), robots_.end(), 0);
  changed_.clear();
  pending_.clear();
  for (const int robot : robots_) {
    situation_.set_path(robot, {});
    const TimedPath& known = root_paths_[robot];
    if (ranked_ != nullptr && !known.empty() && known.goal == goals[robot]) {
      keep(robot, known);
    } else {
      pending_.push_back(robot);
    }
  }
  root_goals_ = goals;
  if (!replan({})) return nullptr;
  ++counts_.roots;
  Node root{};
  for (const auto& [robot, path] : changed_) {
    root.cost += path.cost;
    if (ranked_ != nullptr) root_paths_[robot] = path;
  }
  return &complete(root);
}

void ConstraintTree::make_ranked_root() {
  const RankedGoals::Ranked ranked = *std::move(next_root_);
  Node* root = make_root(ranked.goals);
  if (root != nullptr) push(*root);
  announce_root(root == nullptr ? 0 : root->conflict_count);
}

/// Let the next root be made when no other node costs less.
void ConstraintTree::announce_root(std::int32_t conflicts) {
  next_root_ = ranked_->next();
  if (!next_root_) return;
  open_.push_back({next_root_->cost, conflicts, 0, number_++, nullptr});
  std::ranges::push_heap(open_, std::greater{});
}

}  // namespace mrpbench::mapf
