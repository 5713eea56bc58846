#include "mrpbench_mapf/bounded/bounded_tree.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace mrpbench::mapf {

BoundedTree::BoundedTree(Workbench& bench, const BoundedOptions& options, Result& result)
    : bench_(bench),
      options_(options),
      limits_(bench.limits),
      result_(result),
      robots_(bench.space.instance().size()),
      queue_(options.selection, options.w),
      search_(bench.space, bench.intervals, options, limits_, result.statistics),
      situation_(robots_),
      present_(bench.space, limits_),
      nodes_(limits_),
      plans_(limits_),
      constraints_(limits_),
      conflicts_(limits_),
      conflict_lists_(limits_),
      paths_(!bench.space.instance().rules().disappear_at_goal, limits_),
      reasoning_(bench, constraints_),
      dependencies_(bench),
      current_(robots_) {}

void BoundedTree::solve() {
  start();
  while (!queue_.empty()) {
    result_.lower_bound = std::max(result_.lower_bound, static_cast<double>(queue_.least()));
    const std::int32_t id = queue_.pop();
    if (by_id_[id] == nullptr) {
      make_ranked_root();
      continue;
    }
    Node& node = *by_id_[id];
    visit(node);
    if (node.conflicts.empty()) return finish();
    if (finish_aside()) return;
    if (queue_.popped_to_raise_the_bound() && postpone(id)) continue;
    expand(node);
  }
  result_.status = Status::unsolvable;  // the tree is exhausted
}

/// Once the tree has taken a while, has a search aside of it found a solution that is within the bound?
bool BoundedTree::finish_aside() {
  if (!options_.incumbent_after || options_.techniques.goals != GoalChoice::own) return false;
  const std::int64_t effort = result_.statistics.low_level_expansions - (incumbent_ ? incumbent_->effort() : 0);
  if (effort < root_effort_ + *options_.incumbent_after) return false;
  if (!incumbent_) incumbent_.emplace(bench_.space.instance(), bench_.distances, limits_, result_.statistics);
  incumbent_->advance(effort / 2);
  if (static_cast<double>(incumbent_->cost()) > options_.w * result_.lower_bound) return false;
  result_.paths = incumbent_->paths();
  result_.status = Status::solved;
  return true;
}

void BoundedTree::finish() {
  for (const Plan& plan : current_) result_.paths.push_back(occupations(bench_.space, plan.robot, plan.path));
  result_.status = Status::solved;
}

void BoundedTree::push(const Node* parent, const Child& child) {
  Node& node = nodes_.copy({parent, child.constraints, plans_.copy(child.plans), conflict_lists_.copy(child.conflicts),
                            child.cost, child.least, 0, false, child.assignment});
  if (parent != nullptr) node.heuristic = std::max<Cost>(0, parent->least + parent->heuristic - node.least);
  by_id_.push_back(&node);
  enqueue(static_cast<std::int32_t>(by_id_.size()) - 1);
  ++result_.statistics.generated;
}

void BoundedTree::enqueue(std::int32_t id) {
  const Node& node = *by_id_[id];
  queue_.push({id, node.least + node.heuristic, node.cost, node.conflict_count()},
              estimate(node.cost, node.conflicts.size()));
  constexpr std::size_t kQueueBytes = 300;  // of a node in the queue's trees
  limits_.charge_growth(counted_, by_id_.size() * kQueueBytes);
}

/// Make the paths and constraints of `node` the present ones.
void BoundedTree::visit(const Node& node) {
  wanted_.resize(robots_);
  later_.assign(robots_, false);
  situation_.clear_constraints();
  for (const Node* it = &node; it != nullptr; it = it->parent) {
    for (const Constraint& constraint : it->constraints) situation_.add(constraint);
    for (const Plan& plan : it->plans) {
      if (!later_[plan.robot]) wanted_[plan.robot] = plan;
      later_[plan.robot] = true;
    }
  }
  for (const Plan& plan : wanted_) replace(plan);
  take_up(node);
}

void BoundedTree::replace(const Plan& plan) {
  Plan& current = current_[plan.robot];
  if (!(plan.path == current.path)) {
    present_.remove(plan.robot);
    present_.add(plan.robot, plan.path);
  }
  current = plan;
  situation_.set_path(plan.robot, plan.path, plan.least);
}

/// Find out what pairs of robots add to the lower bound of the node at hand; is it then out of turn, or no good at all?
bool BoundedTree::postpone(std::int32_t id) {
  Node& node = *by_id_[id];
  if (!options_.techniques.heuristic || assignment_ || node.evaluated) return false;
  node.evaluated = true;
  const Cost before = node.least + node.heuristic;
  for (const Conflict* conflict : node.conflicts) {
    tighten(node, conflict->one);
    tighten(node, conflict->other);
  }
  const Cost heuristic = dependencies_.evaluate(situation_, node.conflicts);
  result_.statistics.pair_expansions = dependencies_.counts().expansions;
  if (heuristic == Dependencies::kImpossible) return true;
  node.heuristic = std::max(heuristic, before - node.least);
  if (node.least + node.heuristic <= before) return false;
  enqueue(id);
  return true;
}

void BoundedTree::expand(Node& node) {
  ++result_.statistics.expansions;
  do {
    const Conflict& conflict = choose(node);
    bool bypassed = false;
    for (int side = 0; side < 2 && !bypassed; ++side) {
      children_[side].constraints = conflict.branch[side];
      plan_child(node, children_[side]);
      bypassed = options_.techniques.bypass && bypass(node, children_[side]);
    }
    if (!bypassed) return branch_into_children(node);
    ++result_.statistics.bypasses;
  } while (!node.conflicts.empty());
  push(&node, {true, node.cost, node.least, {}, {}, {}, node.assignment});
}

/// Of the conflicts of `node` the one that raises the lower bound most surely, or just the first.
Conflict& BoundedTree::choose(Node& node) {
  const auto first = [](const Conflict* it) { return std::tuple(it->time, it->one, it->other); };
  if (!options_.techniques.prioritize) {
    Conflict& conflict = **std::ranges::min_element(node.conflicts, {}, first);
    examine(node, conflict);
    return conflict;
  }
  for (Conflict* conflict : node.conflicts) examine(node, *conflict);
  return **std::ranges::min_element(node.conflicts, {}, [&](const Conflict* it) {
    return std::tuple(-static_cast<int>(it->cardinality), -static_cast<int>(it->kind), first(it));
  });
}

void BoundedTree::examine(Node& node, Conflict& conflict) {
  if (conflict.examined) return;
  if (options_.techniques.prioritize) {
    tighten(node, conflict.one);
    tighten(node, conflict.other);
  }
  reasoning_.examine(situation_, conflict);
}

/// Let `node` know what the cheapest path of `robot` costs; unless it might then go elsewhere.
void BoundedTree::tighten(Node& node, int robot) {
  if (assignment_) return;
  const Tick least = bench_.least_cost(situation_, robot);
  Plan plan = current_[robot];
  if (least <= plan.least) return;
  node.least += least - plan.least;
  node.heuristic = std::max<Cost>(0, node.heuristic - (least - plan.least));
  plan.least = least;
  add_plan(node, plan);
}

void BoundedTree::add_plan(Node& node, const Plan& plan) {
  std::vector<Plan> plans(node.plans.begin(), node.plans.end());
  std::erase_if(plans, [&](const Plan& it) { return it.robot == plan.robot; });
  plans.push_back(plan);
  node.plans = plans_.copy(plans);
  replace(plan);
}

void BoundedTree::branch_into_children(const Node& node) {
  const auto value = [&](const Child& child) {
    return child.possible ? estimate(child.cost, child.conflicts.size()) : std::numeric_limits<double>::infinity();
  };
  const Child& best = value(children_[1]) < value(children_[0]) ? children_[1] : children_[0];
  if (best.possible) {
    errors_.observe(best.cost - node.cost, node.conflict_count(), static_cast<std::int32_t>(best.conflicts.size()));
  }
  for (const Child& child : children_) {
    if (child.possible) push(&node, child);
  }
}

/// Replan all robots whose present paths break the constraints of `child`.
void BoundedTree::plan_child(const Node& parent, Child& child) {
  child.cost = parent.cost;
  child.least = parent.least;
  child.plans.clear();
  child.conflicts.assign(parent.conflicts.begin(), parent.conflicts.end());
  before_.clear();
  pending_.clear();
  for (int robot = 0; robot < robots_; ++robot) {
    if (breaks(bench_.space, robot, current_[robot].path, child.constraints)) pending_.push_back(robot);
  }
  child.possible = replan(child);
  for (const Plan& old : before_) replace(old);
  take_up(parent);
}

/// New paths for the robots in `pending_`, and for those that get other goals by that; false if one has none.
bool BoundedTree::replan(Child& child) {
  for (std::size_t k = 0; k < pending_.size(); ++k) {
    const int robot = failed_ = pending_[k];
    const int goal = goal_of(robot);
    if (is_settled(robot, goal, child)) continue;
    const Plan old = current_[robot];
    CostBound bound{options_.w};
    if (options_.flex) bound = {options_.w, child.least - old.least, child.cost - old.path.cost};
    situation_.load(robot, goal, bench_.table);
    bench_.table.add(child.constraints);
    present_.remove(robot);
    present_.refresh();
    const Tick known = assignment_ ? assignment_->bound(robot) : old.least;
    const Tick least =
        search_.search(bench_.table, bench_.distance_to_goal(robot, goal), present_, bound, known, path_);
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
    child.least = assignment_->sum();
    child.assignment = assignment_->keep();
    result_.statistics.assignments = 1 + assignment_->changes();
  }
  return true;
}

int BoundedTree::goal_of(int robot) const {
  if (assignment_) return assignment_->goal(robot);
  const TimedPath& path = current_[robot].path;
  return path.empty() ? root_goals_[robot] : path.goal;
}

/// Is there nothing to be done, though its goal may have changed meanwhile?
bool BoundedTree::is_settled(int robot, int goal, const Child& child) const {
  const TimedPath& path = current_[robot].path;
  if (path.empty() || path.goal != goal) return false;
  const bool changed = std::ranges::find(child.plans, robot, &Plan::robot) != child.plans.end();
  return changed || !breaks(bench_.space, robot, path, child.constraints);
}

/// Let `robot` be among the pending ones from number `asked` on.
void BoundedTree::ask_for(int robot, std::size_t asked) {
  const auto ahead = std::span(pending_).subspan(asked);
  if (std::ranges::find(ahead, robot) == ahead.end()) pending_.push_back(robot);
}

/// Give a robot a new path in the node being made.
void BoundedTree::keep(Child& child, const Plan& plan) {
  const Plan old = current_[plan.robot];
  const auto place = std::ranges::find(child.plans, plan.robot, &Plan::robot);
  if (place != child.plans.end()) {
    *place = plan;
  } else {
    before_.push_back(old);
    child.plans.push_back(plan);
  }
  replace(plan);
  std::erase_if(child.conflicts, [&](const Conflict* it) { return it->one == plan.robot || it->other == plan.robot; });
  find_conflicts(plan.robot, plan.path, child.conflicts);
  child.cost += plan.path.cost - old.path.cost;
  child.least += plan.least - old.least;
}

/// Make the assignment that of `node`, whose paths are present.
void BoundedTree::take_up(const Node& node) {
  if (assignment_) assignment_->restore(*node.assignment, [&](int robot) { return current_[robot].path.goal; });
}

void BoundedTree::find_conflicts(int robot, const TimedPath& path, std::vector<Conflict*>& conflicts) {
  found_.clear();
  present_.refresh();
  mapf::find_conflicts(bench_.space, present_, robot, path, constraints_, found_);
  for (Conflict& conflict : conflicts_.copy(found_)) conflicts.push_back(&conflict);
}

/// Take over the paths of a child that keep to the bound of `node` and have fewer conflicts. Where moves take many
/// ticks they must not cost more: dear detours would use the bound up long before the last conflict is gone.
bool BoundedTree::bypass(Node& node, const Child& child) {
  if (!child.possible || child.conflicts.size() >= node.conflicts.size()) return false;
  if (static_cast<double>(child.cost) > options_.w * static_cast<double>(node.least)) return false;
  if (!bench_.space.textbook() && child.cost > node.cost) return false;
  if (!options_.flex && std::ranges::any_of(child.plans, [&](const Plan& plan) {
        return plan.path.cost > CostBound{options_.w}(current_[plan.robot].least);
      })) {
    return false;
  }
  // Another assignment has another lower bound.
  if (std::ranges::any_of(child.plans, [&](const Plan& it) { return it.path.goal != current_[it.robot].path.goal; })) {
    return false;
  }
  for (Plan plan : child.plans) {
    plan.least = current_[plan.robot].least;
    add_plan(node, plan);
  }
  node.conflicts = conflict_lists_.copy(child.conflicts);
  node.cost = child.cost;
  return true;
}

}  // namespace mrpbench::mapf
