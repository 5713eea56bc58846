#include "mrpbench_mapf/cbs/constraint_tree.hpp"

#include <algorithm>
#include <functional>
#include <tuple>

#include "mrpbench_mapf/cbs/dependencies.hpp"

namespace mrpbench::mapf {

ConstraintTree::ConstraintTree(Workbench& bench, Dependencies* dependencies)
    : bench_(bench),
      dependencies_(dependencies),
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

std::optional<int> ConstraintTree::start() {
  clear();
  Node root{};
  for (int robot = 0; robot < bench_.space.instance().size(); ++robot) {
    if (!bench_.plan(situation_, robot, {}, &others_, path_)) return robot;
    begin_with(robot, paths_.keep(path_));
    root.cost += path_.cost;
  }
  push(complete(root));
  return std::nullopt;
}

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
  bench_.plan(situation, robot, {}, nullptr, path_);
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
}

ConstraintTree::Outcome ConstraintTree::run(std::int64_t expansions) {
  while (!open_.empty()) {
    std::ranges::pop_heap(open_, std::greater{});
    Node* node = open_.back().node;
    lower_bound_ = std::max(lower_bound_, open_.back().f);
    open_.pop_back();
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
  Node* node = nullptr;
  if (replan_all(constraints)) {
    Node made{&parent, constraints, {}, {}, parent.cost, 0, 0, false};
    for (const auto& [robot, path] : changed_) made.cost += path.cost - before_[robot].cost;
    made.heuristic = std::max<Cost>(0, parent.cost + parent.heuristic - made.cost);
    made.conflict_count = static_cast<std::int32_t>(std::ranges::count_if(
        present_, [&](const Conflict* it) { return !is_changed(it->one) && !is_changed(it->other); }));
    node = &complete(made);
  }
  for (const Replanned& it : changed_) replace(it.robot, before_[it.robot]);
  others_.refresh();
  return node;
}

/// New paths for all robots that break `constraints`; false if one has none.
bool ConstraintTree::replan_all(std::span<const Constraint> constraints) {
  for (const int robot : robots_) {
    if (!breaks(bench_.space, robot, situation_.path(robot), constraints)) continue;
    others_.remove(robot);
    others_.refresh();
    const bool found = bench_.plan(situation_, robot, constraints, &others_, path_);
    others_.add(robot, situation_.path(robot));
    if (!found) return false;
    before_[robot] = situation_.path(robot);
    changed_.push_back({robot, paths_.keep(path_)});
    replace(robot, changed_.back().path);
  }
  others_.refresh();
  return true;
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
  ++counts_.generated;
  return nodes_.copy(node);
}

void ConstraintTree::push(Node& node) {
  open_.push_back({node.cost + node.heuristic, node.conflict_count, node.heuristic, number_++, &node});
  std::ranges::push_heap(open_, std::greater{});
  bench_.limits.charge_growth(counted_, open_.capacity() * sizeof(Open));
}

}  // namespace mrpbench::mapf
