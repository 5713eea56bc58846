#include <numeric>

#include "mrpbench_mapf/cbs/tree/constraint_tree.hpp"

namespace mrpbench::mapf {

bool ConstraintTree::start() {
  clear();
  const GoalChoice goals = options_.goals;
  if (goals == GoalChoice::ranked) {
    ranked_.emplace(find_candidates(context_), context_.limits);
    announce_root(0);
    return true;
  }
  if (goals == GoalChoice::by_node && !assignment_.emplace(find_candidates(context_), context_.limits).solve())
    return false;
  const std::vector<int> any(context_.space.instance().size(), TimedPath::kAnyGoal);
  return make_root(any);
}

void ConstraintTree::start(const NodeState& state, int one, int other) {
  clear();
  Child& root = children_[0];
  root = {};
  root_constraints_.clear();
  for (const int robot : {one, other}) {
    const auto own = state.constraints(robot);
    root_constraints_.insert(root_constraints_.end(), own.begin(), own.end());
    robots_.push_back(robot);
    TimedPath path = state.path(robot);
    if (path.cost > state.least(robot)) {
      present_.refresh();
      plan(state, robot, path.goal, {}, state.least(robot), {});
      path = paths_.keep(path_);
    }
    keep(root, {robot, path.cost, path});
  }
  for (const Constraint& constraint : state.parked()) {
    if (constraint.robot != one && constraint.robot != other) root_constraints_.push_back(constraint);
  }
  root.constraints = constraints_.copy(root_constraints_);
  list_conflicts({}, root);
  push(nullptr, root);
}

void ConstraintTree::clear() {
  for (const int robot : robots_) replace({robot, 0, {}});
  robots_.clear();
  open_.clear();
  by_id_.clear();
  nodes_.clear();
  plans_.clear();
  constraints_.clear();
  conflicts_.clear();
  conflict_lists_.clear();
  paths_.clear();
  state_.clear_constraints();
  lower_bound_ = 0;
}

/// Put a node without constraints in which robots go to `goals` into the open list. False if one cannot.
bool ConstraintTree::make_root(std::span<const int> goals) {
  state_.clear_constraints();
  for (const int robot : robots_) replace({robot, 0, {}});
  robots_.resize(context_.space.instance().size());
  std::iota(robots_.begin(), robots_.end(), 0);
  Child& root = children_[0];
  root = {};
  before_.clear();
  pending_.clear();
  root_plans_.resize(robots_.size());
  for (const int robot : robots_) {
    const RobotPlan& known = root_plans_[robot];
    if (!known.path.empty() && known.path.goal == goals[robot]) {
      keep(root, known);
    } else {
      pending_.push_back(robot);
    }
  }
  root_goals_ = goals;
  if (!replan(root)) return false;
  list_conflicts({}, root);
  if (ranked_) {
    for (const RobotPlan& plan : root.plans) root_plans_[plan.robot] = plan;
  }
  ++counts_.roots;
  push(nullptr, root);
  return true;
}

void ConstraintTree::make_ranked_root() {
  const RankedGoals::Ranked ranked = *std::move(next_root_);
  const bool made = make_root(ranked.goals);
  announce_root(made ? static_cast<std::int32_t>(children_[0].conflicts.size()) : 0);
}

/// Announce the root for the next goals; it is made when it is taken out of the open list.
void ConstraintTree::announce_root(std::int32_t conflicts) {
  next_root_ = ranked_->next();
  if (!next_root_) return;
  by_id_.push_back(nullptr);
  open_.push_root(static_cast<std::int32_t>(by_id_.size()) - 1, next_root_->cost, conflicts);
}

}  // namespace mrpbench::mapf
