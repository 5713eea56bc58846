#include "mrpbench_mapf/cbs/tree/constraint_tree.hpp"

#include <algorithm>
#include <tuple>

#include "mrpbench_mapf/cbs/tree/dependencies.hpp"

namespace mrpbench::mapf {

ConstraintTree::ConstraintTree(SearchContext& context, OpenList& open, LowLevel& low_level, Dependencies* dependencies)
    : context_(context),
      open_(open),
      low_level_(low_level),
      dependencies_(dependencies),
      optimal_(low_level.is_optimal()),
      state_(context.space.instance().size()),
      present_(context.space, context.limits),
      nodes_(context.limits),
      plans_(context.limits),
      constraints_(context.limits),
      conflicts_(context.limits),
      conflict_lists_(context.limits),
      paths_(!context.space.instance().rules().disappear_at_goal, context.limits),
      reasoning_(context, constraints_),
      marked_(context.space.instance().size()) {}

std::int64_t ConstraintTree::assignments() const {
  if (assignment_) return 1 + assignment_->changes();
  return ranked_ ? counts_.roots : 0;
}

bool ConstraintTree::next() {
  while (!open_.empty()) {
    lower_bound_ = std::max(lower_bound_, open_.least());
    id_ = open_.pop();
    node_ = by_id_[id_];
    if (node_ != nullptr) {
      visit(*node_);
      return true;
    }
    make_ranked_root();
  }
  return false;
}

bool ConstraintTree::expand(std::int64_t most) {
  if (postpone()) return true;
  ++counts_.expanded;
  while (!node_->conflicts.empty()) {
    if (counts_.resolved >= most) return false;
    ++counts_.resolved;
    if (!resolve(choose())) return true;
    ++counts_.bypasses;
  }
  push(node_, {true, node_->sums, {}, {}, {}, node_->assignment});
  return true;
}

void ConstraintTree::push(const Node* parent, const Child& child) {
  Node& node = nodes_.copy({parent, child.constraints, plans_.copy(child.plans), conflict_lists_.copy(child.conflicts),
                            child.sums, 0, false, child.assignment});
  if (parent != nullptr) {
    node.heuristic = std::max<Cost>(0, parent->sums.least + parent->heuristic - node.sums.least);
  }
  by_id_.push_back(&node);
  open_.push(candidate(static_cast<std::int32_t>(by_id_.size()) - 1, node));
  ++counts_.generated;
}

Candidate ConstraintTree::candidate(std::int32_t id, const Node& node) const {
  return {id, node.sums.least + node.heuristic, node.heuristic, node.sums.cost,
          static_cast<std::int32_t>(node.conflicts.size())};
}

/// Make the paths and constraints of `node` the present ones.
void ConstraintTree::visit(const Node& node) {
  std::ranges::fill(marked_, false);
  state_.clear_constraints();
  for (const Node* it = &node; it != nullptr; it = it->parent) {
    for (const Constraint& constraint : it->constraints) state_.add(constraint);
    for (const RobotPlan& plan : it->plans) {
      if (!marked_[plan.robot]) replace(plan);
      marked_[plan.robot] = true;
    }
  }
  std::ranges::fill(marked_, false);
  restore_assignment(node);
}

void ConstraintTree::replace(const RobotPlan& plan) {
  if (!(plan.path == state_.path(plan.robot))) {
    present_.remove(plan.robot);
    present_.add(plan.robot, plan.path);
  }
  state_.set_path(plan.robot, plan.path, plan.least);
}

/// Find out what pairs of robots add to the lower bound of the node at hand; is it then out of turn, or no good at all?
bool ConstraintTree::postpone() {
  Node& node = *node_;
  if (dependencies_ == nullptr || node.evaluated || !open_.popped_for_its_bound()) return false;
  node.evaluated = true;
  const Cost before = node.sums.least + node.heuristic;
  for (const Conflict* conflict : node.conflicts) {
    tighten(conflict->one);
    tighten(conflict->other);
  }
  const Cost heuristic = dependencies_->evaluate(state_, node.conflicts);
  if (heuristic == Dependencies::kImpossible) return true;
  node.heuristic = std::max(heuristic, before - node.sums.least);
  if (node.sums.least + node.heuristic <= before) return false;
  open_.push(candidate(id_, node));
  return true;
}

/// Of the conflicts of the node at hand the one that raises the lower bound most surely, or just the first.
Conflict& ConstraintTree::choose() {
  // Where paths are the cheapest, the newest of several that are first comes first.
  const auto first = [&](const Conflict* it) {
    return optimal_ ? std::tuple(it->time, 0, 0) : std::tuple(it->time, it->one, it->other);
  };
  if (!context_.options.prioritize) {
    Conflict& conflict = **std::ranges::min_element(node_->conflicts, {}, first);
    examine(conflict);
    return conflict;
  }
  for (Conflict* conflict : node_->conflicts) examine(*conflict);
  return **std::ranges::min_element(node_->conflicts, {}, [&](const Conflict* it) {
    return std::tuple(-static_cast<int>(it->cardinality), -static_cast<int>(it->kind), first(it));
  });
}

void ConstraintTree::examine(Conflict& conflict) {
  if (conflict.examined) return;
  if (context_.options.prioritize) {
    tighten(conflict.one);
    tighten(conflict.other);
  }
  reasoning_.examine(state_, conflict);
}

/// Let the node at hand know what the cheapest path of `robot` costs; unless the robot might then go elsewhere.
void ConstraintTree::tighten(int robot) {
  if (assignment_) return;
  const Tick least = context_.least_cost(state_, robot);
  RobotPlan plan = plan_of(robot);
  const Tick more = least - plan.least;
  if (more <= 0) return;
  plan.least = least;
  node_->sums.least += more;
  node_->heuristic = std::max<Cost>(0, node_->heuristic - more);
  take_over(std::span(&plan, 1));
}

/// Make children that resolve `conflict`; true if one of them bypasses it.
bool ConstraintTree::resolve(const Conflict& conflict) {
  for (int side = 0; side < 2; ++side) {
    plan_child(conflict.branch[side], children_[side]);
    if (context_.options.bypass && bypass(children_[side])) return true;
  }
  branch();
  return false;
}

/// Let the node at hand have the paths of a child with fewer conflicts, if they are good enough. Its lower bounds stay
/// what they are, since the constraints of the child are not its own.
bool ConstraintTree::bypass(const Child& child) {
  if (!child.possible || child.conflicts.size() >= node_->conflicts.size()) return false;
  if (!low_level_.allows_bypass(state_, node_->sums, child.sums, child.plans)) return false;
  before_ = child.plans;
  for (RobotPlan& plan : before_) {
    if (plan.path.goal == state_.path(plan.robot).goal) plan.least = state_.least(plan.robot);
  }
  take_over(before_);
  node_->conflicts = conflict_lists_.copy(child.conflicts);
  node_->sums.cost = child.sums.cost;
  restore_assignment(*node_);
  return true;
}

/// Make `plans` those of the node at hand.
void ConstraintTree::take_over(std::span<const RobotPlan> plans) {
  merged_.assign(plans.begin(), plans.end());
  for (const RobotPlan& plan : node_->plans) {
    if (std::ranges::find(plans, plan.robot, &RobotPlan::robot) == plans.end()) merged_.push_back(plan);
  }
  node_->plans = plans_.copy(merged_);
  for (const RobotPlan& plan : plans) replace(plan);
}

void ConstraintTree::branch() {
  std::array<Candidate, 2> made;
  std::size_t count = 0;
  for (const Child& child : children_) {
    if (!child.possible) continue;
    made[count++] = {-1, child.sums.least, 0, child.sums.cost, static_cast<std::int32_t>(child.conflicts.size())};
  }
  open_.learn(candidate(id_, *node_), std::span(made).first(count));
  for (const Child& child : children_) {
    if (child.possible) push(node_, child);
  }
}

/// Plan all robots whose present paths break `constraints` anew.
void ConstraintTree::plan_child(std::span<const Constraint> constraints, Child& child) {
  child.constraints = constraints;
  child.sums = node_->sums;
  child.plans.clear();
  before_.clear();
  pending_.clear();
  for (const int robot : robots_) {
    if (breaks(context_.space, robot, state_.path(robot), constraints)) pending_.push_back(robot);
  }
  child.possible = replan(child);
  if (child.possible) list_conflicts(node_->conflicts, child);
  for (const RobotPlan& old : before_) replace(old);
  restore_assignment(*node_);
}

/// New paths for the robots in `pending_`, and for those that get other goals by that; false if one has none.
bool ConstraintTree::replan(Child& child) {
  for (std::size_t k = 0; k < pending_.size(); ++k) {
    const int robot = failed_ = pending_[k];
    const int goal = goal_of(robot);
    if (is_settled(robot, goal, child)) continue;
    const RobotPlan old = plan_of(robot);
    present_.remove(robot);
    present_.refresh();
    const Tick known = assignment_ ? assignment_->bound(robot) : old.least;
    const Sums others{child.sums.cost - old.path.cost, child.sums.least - old.least};
    const Tick least = low_level_.plan(state_, robot, goal, child.constraints, present_, known, others, path_);
    present_.add(robot, old.path);
    if (assignment_) {
      if (!assignment_->raise(robot, least, [&](int other) { ask_for(other, k + 1); })) return false;
      if (goal_of(robot) != goal) continue;
    } else if (least == kForever) {
      return false;
    }
    keep(child, {robot, least, paths_.keep(path_)});
  }
  if (assignment_) {
    child.sums.least = assignment_->sum();
    child.assignment = assignment_->keep();
  }
  return true;
}

int ConstraintTree::goal_of(int robot) const {
  if (assignment_) return assignment_->goal(robot);
  const TimedPath& path = state_.path(robot);
  return path.empty() ? root_goals_[robot] : path.goal;
}

/// Is there nothing to be done, though its goal may have changed meanwhile?
bool ConstraintTree::is_settled(int robot, int goal, const Child& child) const {
  const TimedPath& path = state_.path(robot);
  if (path.empty() || path.goal != goal) return false;
  const bool changed = std::ranges::find(child.plans, robot, &RobotPlan::robot) != child.plans.end();
  return changed || !breaks(context_.space, robot, path, child.constraints);
}

/// Let `robot` be among the pending ones from number `asked` on.
void ConstraintTree::ask_for(int robot, std::size_t asked) {
  const auto ahead = std::span(pending_).subspan(asked);
  if (std::ranges::find(ahead, robot) == ahead.end()) pending_.push_back(robot);
}

/// Give a robot a new path in the node being made.
void ConstraintTree::keep(Child& child, const RobotPlan& plan) {
  const RobotPlan old = plan_of(plan.robot);
  const auto place = std::ranges::find(child.plans, plan.robot, &RobotPlan::robot);
  if (place == child.plans.end()) {
    before_.push_back(old);
    child.plans.push_back(plan);
  } else {
    *place = plan;
    if (!optimal_) std::rotate(place, place + 1, child.plans.end());  // in the order in which they were planned last
  }
  replace(plan);
  child.sums.cost += plan.path.cost - old.path.cost;
  child.sums.least += plan.least - old.least;
}

/// Make the assignment that of `node`, whose paths are present.
void ConstraintTree::restore_assignment(const Node& node) {
  if (!assignment_) return;
  assignment_->restore(*node.assignment, [&](int robot) { return state_.path(robot).goal; });
}

/// Find the conflicts of the node being made, whose paths are present: the new ones, then those of `inherited` that are
/// left.
void ConstraintTree::list_conflicts(std::span<Conflict* const> inherited, Child& child) {
  found_.clear();
  present_.refresh();
  const std::size_t count = child.plans.size();
  for (std::size_t k = 0; k < count; ++k) {
    // Of two robots planned anew, the first in a conflict is the one planned first, or last where paths are bounded.
    const RobotPlan& plan = child.plans[optimal_ ? k : count - 1 - k];
    context_.limits.check();
    const auto before = static_cast<std::ptrdiff_t>(found_.size());
    find_conflicts(context_.space, present_, plan.robot, plan.path, constraints_, found_);
    const auto is_known = [&](const Conflict& it) { return marked_[it.other]; };
    found_.erase(std::remove_if(found_.begin() + before, found_.end(), is_known), found_.end());
    marked_[plan.robot] = true;
  }
  child.conflicts.clear();
  for (Conflict& conflict : conflicts_.copy(found_)) child.conflicts.push_back(&conflict);
  for (Conflict* it : inherited) {
    if (!marked_[it->one] && !marked_[it->other]) child.conflicts.push_back(it);
  }
  for (const RobotPlan& plan : child.plans) marked_[plan.robot] = false;
  ++counts_.planned;
}

}  // namespace mrpbench::mapf
