// The constraint tree of bounded-suboptimal conflict-based search, on any `Space` that plans for single robots:
//   Step, Conflict, Constraint   what paths, conflicts and constraints consist of
//   robots()
//   put(robot, path), take(robot)   the present paths, which plans try not to meet
//   bind(robot), add(constraint), plan(bound, known, path)   a path for one robot under constraints
//   find_conflicts(robot, path, found)   with all present paths of others
//   resolve(conflict, constraints_of, branch)   two lists of constraints: every solution keeps all of one of them
//   keeps(robot, path, constraint), cost(path), finish(robot, path)
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "mrpbench_mapf/arena.hpp"
#include "mrpbench_mapf/bounded/cost_bound.hpp"
#include "mrpbench_mapf/bounded/node_queue.hpp"
#include "mrpbench_mapf/result.hpp"

namespace mrpbench::mapf {

template <class Space>
class BoundedTree {
 public:
  BoundedTree(Space& space, const BoundedOptions& options, Limits& limits, Result& result)
      : space_(space),
        options_(options),
        limits_(limits),
        result_(result),
        queue_(options.selection, options.w),
        nodes_(limits),
        steps_(limits),
        plans_(limits),
        constraints_(limits),
        conflicts_(limits),
        current_(space.robots()) {}

  void solve() {
    if (const std::optional<int> robot = plan_root()) {
      result_.statistics.failed_robot = *robot;
      result_.status = Status::unsolvable;
      return;
    }
    while (!queue_.empty()) {
      result_.lower_bound = std::max(result_.lower_bound, static_cast<double>(queue_.least()));
      Node& node = *by_id_[queue_.pop()];
      visit(node);
      if (node.conflicts.empty()) return finish();
      expand(node);
    }
    result_.status = Status::unsolvable;  // the tree is exhausted
  }

 private:
  using Step = typename Space::Step;
  using Conflict = typename Space::Conflict;
  using Constraint = typename Space::Constraint;

  /// The path of a robot, and the least cost of any that its constraints allow.
  struct Plan {
    std::int32_t robot;
    Tick least;
    std::span<const Step> path;
  };
  /// A node of the constraint tree, as what differs from its parent; but it lists all conflicts.
  struct Node {
    const Node* parent = nullptr;
    std::span<const Constraint> constraints;
    std::span<const Plan> plans;
    std::span<const Conflict> conflicts;
    Cost cost = 0, least = 0;

    std::int32_t conflict_count() const { return static_cast<std::int32_t>(conflicts.size()); }
  };
  /// A node being made.
  struct Child {
    bool possible = false;
    Cost cost = 0, least = 0;
    std::vector<Constraint> constraints;
    std::vector<Plan> plans;
    std::vector<Conflict> conflicts;
  };

  /// Plan every robot without constraints; the robot that has no path, or nothing.
  std::optional<int> plan_root() {
    Child root;
    for (int robot = 0; robot < space_.robots(); ++robot) {
      space_.bind(robot);
      const Tick least = space_.plan({options_.w}, 0, path_);
      if (least == kForever) return robot;
      space_.find_conflicts(robot, path_, root.conflicts);
      current_[robot] = {robot, least, steps_.copy(path_)};
      space_.put(robot, current_[robot].path);
      root.cost += space_.cost(path_);
      root.least += least;
    }
    root_ = current_;
    push(nullptr, root);
    return std::nullopt;
  }

  void finish() {
    for (const Plan& plan : current_) result_.paths.push_back(space_.finish(plan.robot, plan.path));
    result_.status = Status::solved;
  }

  void push(const Node* parent, const Child& child) {
    by_id_.push_back(&nodes_.copy({parent, constraints_.copy(child.constraints), plans_.copy(child.plans),
                                   conflicts_.copy(child.conflicts), child.cost, child.least}));
    enqueue(static_cast<std::int32_t>(by_id_.size()) - 1);
    ++result_.statistics.generated;
  }

  void enqueue(std::int32_t id) {
    const Node& node = *by_id_[id];
    queue_.push({id, node.least, node.cost, node.conflict_count()}, estimate(node.cost, node.conflict_count()));
    constexpr std::size_t kQueueBytes = 300;  // of a node in the queue's trees
    limits_.charge_growth(counted_, by_id_.size() * kQueueBytes);
  }

  double estimate(Cost cost, std::int32_t conflicts) const { return errors_.estimate(cost, conflicts); }

  /// Make the paths of `node` the present ones.
  void visit(const Node& node) {
    wanted_ = root_;
    later_.assign(wanted_.size(), false);
    for (const Node* it = &node; it != nullptr; it = it->parent) {
      for (const Plan& plan : it->plans) {
        if (!later_[plan.robot]) wanted_[plan.robot] = plan;
        later_[plan.robot] = true;
      }
    }
    for (const Plan& plan : wanted_) {
      if (plan.path.data() != current_[plan.robot].path.data()) replace(plan);
      current_[plan.robot].least = plan.least;
    }
  }

  void replace(const Plan& plan) {
    space_.take(plan.robot);
    space_.put(plan.robot, plan.path);
    current_[plan.robot] = plan;
  }

  void bind(int robot, const Node& node) {
    space_.bind(robot);
    for (const Node* it = &node; it != nullptr; it = it->parent) {
      for (const Constraint& constraint : it->constraints) space_.add(constraint);
    }
  }

  void expand(Node& node) {
    ++result_.statistics.expansions;
    do {
      const Conflict& conflict = *std::ranges::min_element(node.conflicts, {}, &Conflict::time);
      std::array<std::vector<Constraint>, 2> branch;
      space_.resolve(conflict, [&](int robot) { bind(robot, node); }, branch);
      bool bypassed = false;
      for (int side = 0; side < 2 && !bypassed; ++side) {
        children_[side].constraints = branch[side];
        plan_child(node, children_[side]);
        bypassed = options_.bypass && bypass(node, children_[side]);
      }
      if (!bypassed) return branch_into_children(node);
      ++result_.statistics.bypasses;
    } while (!node.conflicts.empty());
    push(&node, {true, node.cost, node.least, {}, {}, {}});
  }

  void branch_into_children(const Node& node) {
    const auto value = [&](const Child& child) {
      return child.possible ? estimate(child.cost, static_cast<std::int32_t>(child.conflicts.size()))
                            : std::numeric_limits<double>::infinity();
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
  void plan_child(const Node& parent, Child& child) {
    child.possible = true;
    child.cost = parent.cost;
    child.least = parent.least;
    child.plans.clear();
    child.conflicts.assign(parent.conflicts.begin(), parent.conflicts.end());
    before_.clear();
    for (int robot = 0; robot < space_.robots() && child.possible; ++robot) {
      const Plan old = current_[robot];
      if (std::ranges::all_of(child.constraints,
                              [&](const Constraint& it) { return space_.keeps(robot, old.path, it); })) {
        continue;
      }
      child.possible = replan(parent, child, old);
      if (child.possible) before_.push_back(old);
    }
    for (const Plan& old : before_) replace(old);
  }

  bool replan(const Node& parent, Child& child, const Plan& old) {
    CostBound bound{options_.w};
    if (options_.flex) bound = {options_.w, child.least - old.least, child.cost - space_.cost(old.path)};
    bind(old.robot, parent);
    for (const Constraint& constraint : child.constraints) space_.add(constraint);
    space_.take(old.robot);
    const Tick least = space_.plan(bound, old.least, path_);
    if (least == kForever) {
      space_.put(old.robot, old.path);
      return false;
    }
    std::erase_if(child.conflicts, [&](const Conflict& it) { return it.one == old.robot || it.other == old.robot; });
    space_.find_conflicts(old.robot, path_, child.conflicts);
    const Plan plan{old.robot, least, steps_.copy(path_)};
    space_.put(plan.robot, plan.path);
    current_[plan.robot] = plan;
    child.plans.push_back(plan);
    child.cost += space_.cost(plan.path) - space_.cost(old.path);
    child.least += least - old.least;
    return true;
  }

  /// Take over the paths of a child that keep to the bound of `node` and have fewer conflicts.
  bool bypass(Node& node, const Child& child) {
    if (!child.possible || child.conflicts.size() >= node.conflicts.size()) return false;
    if (static_cast<double>(child.cost) > options_.w * static_cast<double>(node.least)) return false;
    if (!options_.flex && std::ranges::any_of(child.plans, [&](const Plan& plan) {
          return space_.cost(plan.path) > CostBound{options_.w}(current_[plan.robot].least);
        })) {
      return false;
    }
    std::vector<Plan> plans(node.plans.begin(), node.plans.end());
    for (Plan plan : child.plans) {
      std::erase_if(plans, [&](const Plan& it) { return it.robot == plan.robot; });
      plan.least = current_[plan.robot].least;
      plans.push_back(plan);
      replace(plan);
    }
    node.plans = plans_.copy(plans);
    node.conflicts = conflicts_.copy(child.conflicts);
    node.cost = child.cost;
    return true;
  }

  Space& space_;
  const BoundedOptions& options_;
  Limits& limits_;
  Result& result_;
  OnlineErrors errors_;
  NodeQueue queue_;
  Arena<Node> nodes_;
  Arena<Step> steps_;
  Arena<Plan> plans_;
  Arena<Constraint> constraints_;
  Arena<Conflict> conflicts_;
  std::vector<Node*> by_id_;
  std::size_t counted_ = 0;
  std::vector<Plan> root_, current_;  // by robot
  std::array<Child, 2> children_;
  // scratch
  std::vector<Plan> wanted_, before_;
  std::vector<bool> later_;
  std::vector<Step> path_;
};

}  // namespace mrpbench::mapf
