#include "mrpbench_mapf/cbs/tree/constraint_tree.hpp"

#include <algorithm>
#include <tuple>

#include "mrpbench_mapf/cbs/tree/dependencies.hpp"

namespace mrpbench::mapf {

ConstraintTree::ConstraintTree(SearchContext& context, OpenList& open, const CbsOptions& options,
                               Dependencies* dependencies)
    : context_(context),
      open_(open),
      options_(options),
      dependencies_(dependencies),
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

void ConstraintTree::expand() {
  if (postpone()) return;
  ++counts_.expanded;
  while (!node_->conflicts.empty()) {
    if (!resolve(choose())) return;
    ++counts_.bypasses;
  }
  push(node_, {true, node_->sums, {}, {}, {}, node_->assignment});
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

/// Add what pairs of robots still have to pay to the lower bound of the node at hand. True if another node then comes
/// first, or if the node has no solution.
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

/// The conflict of the node at hand whose branches raise the lower bound most surely, or just the first one.
Conflict& ConstraintTree::choose() {
  if (!options_.prioritize) {
    Conflict& conflict = **std::ranges::min_element(node_->conflicts, {}, &Conflict::time);
    examine(conflict);
    return conflict;
  }
  for (Conflict* conflict : node_->conflicts) examine(*conflict);
  return **std::ranges::min_element(node_->conflicts, {}, [&](const Conflict* it) {
    return std::tuple(-static_cast<int>(it->cardinality), -static_cast<int>(it->kind), it->time);
  });
}

void ConstraintTree::examine(Conflict& conflict) {
  if (conflict.examined) return;
  if (options_.prioritize) {
    tighten(conflict.one);
    tighten(conflict.other);
  }
  reasoning_.examine(state_, conflict);
}

/// Raise the lower bound of the node at hand to the cost of the cheapest path of `robot`, unless assignments may
/// change.
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
    if (options_.bypass && bypass(children_[side])) return true;
  }
  branch();
  return false;
}

/// May the node at hand take over the paths of `child`? Where moves take many ticks they must not cost more, because
/// expensive detours would use up the bound before the last conflict is resolved. Another assignment has another lower
/// bound.
bool ConstraintTree::allows_bypass(const Child& child) const {
  if (!child.possible || child.conflicts.size() >= node_->conflicts.size()) return false;
  if (static_cast<double>(child.sums.cost) > options_.w * static_cast<double>(node_->sums.least)) return false;
  if (!context_.space.classical() && child.sums.cost > node_->sums.cost) return false;
  return std::ranges::all_of(child.plans, [&](const RobotPlan& it) {
    const bool within = options_.flex || it.path.cost <= CostBound{options_.w}(state_.least(it.robot));
    return within && it.path.goal == state_.path(it.robot).goal;
  });
}

/// Give the node at hand the paths of a child with fewer conflicts. Its lower bounds do not change, since the
/// constraints of the child do not hold for it.
bool ConstraintTree::bypass(const Child& child) {
  if (!allows_bypass(child)) return false;
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

/// Restore the assignment of `node`, whose paths are present.
void ConstraintTree::restore_assignment(const Node& node) {
  if (!assignment_) return;
  assignment_->restore(*node.assignment, [&](int robot) { return state_.path(robot).goal; });
}

}  // namespace mrpbench::mapf
