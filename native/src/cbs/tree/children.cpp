#include <algorithm>

#include "mrpbench_mapf/cbs/tree/constraint_tree.hpp"

namespace mrpbench::mapf {

/// Replan all robots whose present paths break `constraints`.
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

/// New paths for the robots in `pending_`, and for robots that get other goals because of them; false if a robot has
/// none.
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
    const Tick least = plan(state_, robot, goal, child.constraints, known, others);
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

/// Write a path of `robot` to `goal` under its constraints in `state` and `more` into `path_`. Returns a lower bound on
/// the cost of all such paths, at least `known`, which must be one, or kForever if there is none. `others` are the sums
/// over the other robots, which are in `present_`.
Tick ConstraintTree::plan(const NodeState& state, int robot, int goal, std::span<const Constraint> more, Tick known,
                          const Sums& others) {
  state.load(robot, goal, context_.table);
  context_.table.add(more);
  DistanceTable& distance = context_.distance_to_goal(robot, goal);
  const CostBound bound = options_.flex ? CostBound{options_.w, others.least, others.cost} : CostBound{options_.w};
  if (!context_.soft_intervals) {
    return context_.search.search(context_.table, distance, present_, options_.order, bound, known, path_);
  }
  const Tick least = context_.intervals.least_cost(context_.table, distance);
  if (least == kForever) return kForever;
  const Tick latest = std::min(bound(least), context_.table.latest_finish());
  const bool found = context_.soft_intervals->search(context_.table, distance, &present_, latest, path_);
  return found ? std::max(known, least) : kForever;
}

int ConstraintTree::goal_of(int robot) const {
  if (assignment_) return assignment_->goal(robot);
  const TimedPath& path = state_.path(robot);
  return path.empty() ? root_goals_[robot] : path.goal;
}

/// Tell whether the robot already has a path to `goal` that satisfies the constraints of `child`.
bool ConstraintTree::is_settled(int robot, int goal, const Child& child) const {
  const TimedPath& path = state_.path(robot);
  if (path.empty() || path.goal != goal) return false;
  const bool changed = std::ranges::find(child.plans, robot, &RobotPlan::robot) != child.plans.end();
  return changed || !breaks(context_.space, robot, path, child.constraints);
}

/// Append `robot` to the pending ones, unless it is among those from number `asked` on.
void ConstraintTree::ask_for(int robot, std::size_t asked) {
  const auto ahead = std::span(pending_).subspan(asked);
  if (std::ranges::find(ahead, robot) == ahead.end()) pending_.push_back(robot);
}

/// Give a robot a new path in the new node.
void ConstraintTree::keep(Child& child, const RobotPlan& plan) {
  const RobotPlan old = plan_of(plan.robot);
  const auto place = std::ranges::find(child.plans, plan.robot, &RobotPlan::robot);
  if (place == child.plans.end()) {
    before_.push_back(old);
    child.plans.push_back(plan);
  } else {
    *place = plan;
  }
  replace(plan);
  child.sums.cost += plan.path.cost - old.path.cost;
  child.sums.least += plan.least - old.least;
}

/// List the conflicts of the new node, whose paths are present: the new ones, then the remaining ones of `inherited`.
void ConstraintTree::list_conflicts(std::span<Conflict* const> inherited, Child& child) {
  found_.clear();
  present_.refresh();
  for (const RobotPlan& plan : child.plans) {
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
}

}  // namespace mrpbench::mapf
