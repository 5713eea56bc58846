#include "mrpbench_mapf/cbs/constraint_tree.hpp"

#include <algorithm>
#include <functional>
#include <tuple>

#include "mrpbench_mapf/cbs/dependencies.hpp"

namespace mrpbench::mapf {

ConstraintTree::ConstraintTree(Workbench& bench, Dependencies* dependencies)
    : bench_(bench),
      dependencies_(dependencies),
      root_paths_(bench.space.instance().size()),
      situation_(bench.space.instance().size()),
      others_(bench.space, bench.limits),
      nodes_(bench.limits),
      constraints_(bench.limits),
      conflicts_(bench.limits),
      replanned_(bench.limits),
      reasoning_(bench, constraints_),
      paths_(!bench.space.instance().rules().disappear_at_goal, bench.limits),
      later_(bench.space.instance().size()),
      before_(bench.space.instance().size()) {}

void ConstraintTree::start(const Situation& situation, int one, int other) {
  clear();
  Node root{};
  root_constraints_.clear();
  for (const int robot : {one, other}) {
    const auto own = situation.constraints(robot);
    root_constraints_.insert(root_constraints_.end(), own.begin(), own.end());
    begin_with(robot, cheapest_path(situation, robot));
    root.cost += situation_.path(robot).cost;
  }
  for (const Constraint& constraint : situation.parked()) {
    if (constraint.robot != one && constraint.robot != other) root_constraints_.push_back(constraint);
  }
  root.constraints = constraints_.copy(root_constraints_);
  push(complete(root));
}

TimedPath ConstraintTree::cheapest_path(const Situation& situation, int robot) {
  if (situation.path(robot).cost <= situation.least(robot)) return situation.path(robot);
  bench_.plan(situation, robot, situation.path(robot).goal, {}, nullptr, path_);
  return paths_.keep(path_);
}

void ConstraintTree::clear() {
  for (const int robot : robots_) others_.remove(robot);
  robots_.clear();
  open_.clear();
  nodes_.clear();
  constraints_.clear();
  conflicts_.clear();
  replanned_.clear();
  paths_.clear();
  changed_.clear();
  situation_.clear_constraints();
  lower_bound_ = 0;
  assignment_ = nullptr;
  ranked_ = nullptr;
  std::ranges::fill(root_paths_, TimedPath{});
}

ConstraintTree::Outcome ConstraintTree::run(std::int64_t expansions) {
  while (!open_.empty()) {
    std::ranges::pop_heap(open_, std::greater{});
    Node* node = open_.back().node;
    lower_bound_ = std::max(lower_bound_, open_.back().f);
    open_.pop_back();
    if (node == nullptr) make_ranked_root();
    while (node != nullptr) {
      gather(*node);
      if (present_.empty()) return Outcome::solved;
      if (postpone(*node)) break;
      if (expansions-- <= 0) return Outcome::interrupted;
      node = expand(*node);
    }
  }
  return Outcome::exhausted;
}

void ConstraintTree::begin_with(int robot, const TimedPath& path) {
  robots_.push_back(robot);
  changed_.push_back({robot, path});
  situation_.set_path(robot, path);
  others_.add(robot, path);
  others_.refresh();
}

/// Make `situation_`, `others_` and `present_` those of `node`.
void ConstraintTree::gather(const Node& node) {
  std::ranges::fill(later_, false);
  situation_.clear_constraints();
  present_.clear();
  for (const Node* it = &node; it != nullptr; it = it->parent) {
    for (const Constraint& constraint : it->constraints) situation_.add(constraint);
    for (Conflict& conflict : it->conflicts) {
      if (!later_[conflict.one] && !later_[conflict.other]) present_.push_back(&conflict);
    }
    for (const Replanned& replanned : it->replanned) {
      if (later_[replanned.robot]) continue;
      later_[replanned.robot] = true;
      if (!(situation_.path(replanned.robot) == replanned.path)) replace(replanned.robot, replanned.path);
    }
  }
  others_.refresh();
  take_up(node);
}

/// Find out what the node at hand must still cost; is it then no longer the best, or no good at all?
bool ConstraintTree::postpone(Node& node) {
  if (dependencies_ == nullptr || node.evaluated) return false;
  node.evaluated = true;
  const Cost heuristic = dependencies_->evaluate(situation_, present_);
  if (heuristic == Dependencies::kImpossible) return true;
  if (heuristic <= node.heuristic) return false;
  node.heuristic = heuristic;
  push(node);
  return true;
}

/// Branch; or return the node that bypasses the conflict.
ConstraintTree::Node* ConstraintTree::expand(Node& node) {
  ++counts_.expansions;
  const Conflict& conflict = choose();
  std::array<Node*, 2> children{};
  for (int side = 0; side < 2; ++side) {
    children[side] = child(node, conflict.branch[side]);
    Node* it = children[side];
    if (it != nullptr && bench_.options.bypass && it->cost == node.cost && it->conflict_count < node.conflict_count) {
      it->constraints = {};
      it->assignment = node.assignment;
      it->heuristic = node.heuristic;
      it->evaluated = node.evaluated;
      ++counts_.bypasses;
      return it;
    }
  }
  for (Node* it : children) {
    if (it != nullptr) push(*it);
  }
  return nullptr;
}

/// Of the conflicts of the node at hand the one that raises the cost most surely, or just the first.
const Conflict& ConstraintTree::choose() {
  if (!bench_.options.prioritize) {
    Conflict& first = **std::ranges::min_element(present_, {}, [](const Conflict* it) { return it->time; });
    reasoning_.examine(situation_, first);
    return first;
  }
  for (Conflict* conflict : present_) reasoning_.examine(situation_, *conflict);
  return **std::ranges::min_element(present_, {}, [](const Conflict* it) {
    return std::tuple(-static_cast<int>(it->cardinality), -static_cast<int>(it->kind), it->time);
  });
}

/// The node in which `constraints` are kept as well, or null if there is none.
ConstraintTree::Node* ConstraintTree::child(const Node& parent, std::span<const Constraint> constraints) {
  changed_.clear();
  pending_.clear();
  for (const int robot : robots_) {
    if (breaks(bench_.space, robot, situation_.path(robot), constraints)) pending_.push_back(robot);
  }
  Node* node = nullptr;
  if (replan(constraints)) {
    Node made{&parent, constraints, {}, {}, parent.cost, 0, 0, false, nullptr};
    for (const auto& [robot, path] : changed_) made.cost += path.cost - before_[robot].cost;
    made.heuristic = std::max<Cost>(0, parent.cost + parent.heuristic - made.cost);
    made.conflict_count = static_cast<std::int32_t>(std::ranges::count_if(
        present_, [&](const Conflict* it) { return !is_changed(it->one) && !is_changed(it->other); }));
    node = &complete(made);
  }
  for (const Replanned& it : changed_) replace(it.robot, before_[it.robot]);
  others_.refresh();
  take_up(parent);
  return node;
}

/// New paths for the robots in `pending_`, and for those that get other goals by that; false if one has none.
bool ConstraintTree::replan(std::span<const Constraint> constraints) {
  for (std::size_t k = 0; k < pending_.size(); ++k) {
    const int robot = failed_ = pending_[k];
    const int goal = goal_of(robot);
    if (is_settled(robot, goal, constraints)) continue;
    const TimedPath old = situation_.path(robot);
    others_.remove(robot);
    others_.refresh();
    const bool found = bench_.plan(situation_, robot, goal, constraints, &others_, path_);
    others_.add(robot, old);
    if (assignment_ != nullptr) {
      const Tick cost = found ? path_.cost : kForever;
      if (!assignment_->raise(robot, cost, [&](int other) { ask_for(other, k + 1); })) return false;
      if (goal_of(robot) != goal) continue;
    } else if (!found) {
      return false;
    }
    keep(robot, paths_.keep(path_));
  }
  others_.refresh();
  return true;
}

int ConstraintTree::goal_of(int robot) const {
  if (assignment_ != nullptr) return assignment_->goal(robot);
  return situation_.path(robot).empty() ? root_goals_[robot] : situation_.path(robot).goal;
}

/// Is there nothing to be done, though its goal may have changed meanwhile?
bool ConstraintTree::is_settled(int robot, int goal, std::span<const Constraint> constraints) const {
  const TimedPath& path = situation_.path(robot);
  return !path.empty() && path.goal == goal && (is_changed(robot) || !breaks(bench_.space, robot, path, constraints));
}

/// Let `robot` be among the pending ones from number `asked` on.
void ConstraintTree::ask_for(int robot, std::size_t asked) {
  const auto ahead = std::span(pending_).subspan(asked);
  if (std::ranges::find(ahead, robot) == ahead.end()) pending_.push_back(robot);
}

/// Give `robot` a new path in the node being made.
void ConstraintTree::keep(int robot, const TimedPath& path) {
  const auto place = std::ranges::find(changed_, robot, &Replanned::robot);
  if (place != changed_.end()) {
    place->path = path;
  } else {
    before_[robot] = situation_.path(robot);
    changed_.push_back({robot, path});
  }
  replace(robot, path);
}

/// Make the assignment that of `node`, whose paths are in `situation_`.
void ConstraintTree::take_up(const Node& node) {
  if (assignment_ == nullptr) return;
  assignment_->restore(*node.assignment, [&](int robot) { return situation_.path(robot).goal; });
}

void ConstraintTree::replace(int robot, const TimedPath& path) {
  others_.remove(robot);
  situation_.set_path(robot, path);
  others_.add(robot, path);
}

bool ConstraintTree::is_changed(int robot) const {
  return std::ranges::any_of(changed_, [&](const Replanned& it) { return it.robot == robot; });
}

/// Add the conflicts of the robots in `changed_`, whose paths are in `situation_`, and keep the node.
ConstraintTree::Node& ConstraintTree::complete(Node node) {
  found_.clear();
  for (std::size_t k = 0; k < changed_.size(); ++k) {
    const int robot = changed_[k].robot;
    bench_.limits.check();
    const std::size_t before = found_.size();
    find_conflicts(bench_.space, others_, robot, situation_.path(robot), constraints_, found_);
    const auto is_known = [&](const Conflict& it) {
      return std::ranges::find(changed_.begin(), changed_.begin() + k, it.other, &Replanned::robot) !=
             changed_.begin() + k;
    };
    if (k > 0) found_.erase(std::remove_if(found_.begin() + before, found_.end(), is_known), found_.end());
  }
  node.conflict_count += static_cast<std::int32_t>(found_.size());
  node.conflicts = conflicts_.copy(found_);
  node.replanned = replanned_.copy(changed_);
  if (assignment_ != nullptr) node.assignment = assignment_->keep();
  ++counts_.generated;
  return nodes_.copy(node);
}

void ConstraintTree::push(Node& node) {
  open_.push_back({node.cost + node.heuristic, node.conflict_count, node.heuristic, number_++, &node});
  std::ranges::push_heap(open_, std::greater{});
  bench_.limits.charge_growth(counted_, open_.capacity() * sizeof(Open));
}

}  // namespace mrpbench::mapf
