// The constraint tree of conflict-based search (Sharon, Stern, Felner and Sturtevant, "Conflict-based search for
// optimal multi-agent pathfinding", AIJ 2015) and of its bounded-suboptimal variants: an open list chooses the node to
// expand, a focal search plans the path of one robot. With w = 1 and the least cost first, the tree is that of CBS.
//
// Robots go to any of their goals; or each root of a forest has another assignment (CBS-TA and ECBS-TA: Hoenig, Kiesel,
// Tinka, Durham and Ayanian, "Conflict-based search with optimal task assignment", AAMAS 2018); or each node has
// its own (ITA-CBS: Tang, Ren, Li and Sycara, MRS 2023, see `NodeAssignment`; ITA-ECBS: Tang, Koenig and Li, "ITA-ECBS:
// a bounded-suboptimal algorithm for the combined target-assignment and path-finding problem", SoCS 2024).
#pragma once

#include <optional>

#include "mrpbench_mapf/assignment/node_assignment.hpp"
#include "mrpbench_mapf/cbs/reasoning/reasoning.hpp"
#include "mrpbench_mapf/cbs/tree/open_list.hpp"

namespace mrpbench::mapf {

class Dependencies;

/// The path of a robot, and a lower bound on the cost of all paths that its constraints allow.
struct RobotPlan {
  std::int32_t robot;
  Tick least;
  TimedPath path;
};

/// Sums over robots: what their paths cost, and their lower bounds.
struct Sums {
  Cost cost = 0, least = 0;
};

/// Numbers of nodes, of bypassed conflicts, and of roots.
struct TreeCounts {
  std::int64_t expanded = 0, generated = 0, bypasses = 0, roots = 0;
};

class ConstraintTree {
 public:
  /// With `dependencies`, lower bounds of nodes are raised by what pairs of robots must still cost.
  ConstraintTree(SearchContext& context, OpenList& open, const CbsOptions& options,
                 Dependencies* dependencies = nullptr);

  /// Make the root, for goals as the options say. False if there is no solution.
  bool start();
  /// Begin with the cheapest paths of two robots in `state`, which must exist.
  void start(const NodeState& state, int one, int other);
  /// Take the next node out of the open list. False if there is none: the tree has no solution.
  bool next();
  /// Tell whether the current node has no conflicts.
  bool is_solved() const { return node_->conflicts.empty(); }
  /// Branch on a conflict of the node at hand, bypass it, or put the node back with a higher lower bound.
  void expand();

  /// No solution costs less.
  Cost lower_bound() const { return lower_bound_; }
  const TreeCounts& counts() const { return counts_; }
  /// Assignments of robots to goals that were tried, 0 if each robot keeps to its own goals.
  std::int64_t assignments() const;
  /// A robot that has no path in the root, -1 if none is to blame.
  int failed_robot() const { return failed_; }
  /// The paths of the node at hand: once solved, the solution.
  const NodeState& state() const { return state_; }

 private:
  /// A node stores what differs from its parent; but it lists all conflicts.
  struct Node {
    const Node* parent;
    std::span<const Constraint> constraints;
    std::span<const RobotPlan> plans;
    std::span<Conflict* const> conflicts;
    Sums sums;
    Cost heuristic;  // what pairs of robots add to the lower bound
    bool evaluated;  // `heuristic` is more than what it inherits
    const NodeAssignment::Record* assignment;
  };
  /// A node being made.
  struct Child {
    bool possible = false;
    Sums sums;
    std::span<const Constraint> constraints;
    std::vector<RobotPlan> plans;
    std::vector<Conflict*> conflicts;
    const NodeAssignment::Record* assignment = nullptr;
  };

  void clear();
  bool make_root(std::span<const int> goals);
  void make_ranked_root();
  void announce_root(std::int32_t conflicts);
  void push(const Node* parent, const Child& child);
  Candidate candidate(std::int32_t id, const Node& node) const;
  void visit(const Node& node);
  bool postpone();
  Conflict& choose();
  void examine(Conflict& conflict);
  void tighten(int robot);
  bool resolve(const Conflict& conflict);
  bool allows_bypass(const Child& child) const;
  bool bypass(const Child& child);
  void take_over(std::span<const RobotPlan> plans);
  void branch();
  void plan_child(std::span<const Constraint> constraints, Child& child);
  bool replan(Child& child);
  Tick plan(const NodeState& state, int robot, int goal, std::span<const Constraint> more, Tick known,
            const Sums& others);
  int goal_of(int robot) const;
  bool is_settled(int robot, int goal, const Child& child) const;
  void ask_for(int robot, std::size_t asked);
  void keep(Child& child, const RobotPlan& plan);
  void restore_assignment(const Node& node);
  void list_conflicts(std::span<Conflict* const> inherited, Child& child);
  RobotPlan plan_of(int robot) const { return {robot, state_.least(robot), state_.path(robot)}; }
  void replace(const RobotPlan& plan);

  SearchContext& context_;
  OpenList& open_;
  const CbsOptions options_;
  Dependencies* dependencies_;
  std::vector<int> robots_;
  NodeState state_;  // of the node at hand
  AvoidanceTable present_;
  Arena<Node> nodes_;
  Arena<RobotPlan> plans_;
  Arena<Constraint> constraints_;
  Arena<Conflict> conflicts_;
  Arena<Conflict*> conflict_lists_;
  PathStore paths_;
  Reasoning reasoning_;
  std::optional<NodeAssignment> assignment_;
  std::optional<RankedGoals> ranked_;
  std::optional<RankedGoals::Ranked> next_root_;
  std::vector<RobotPlan> root_plans_;  // by robot: in the last ranked root
  std::vector<Node*> by_id_;           // null: the next root, not yet made
  std::int32_t id_ = -1;
  Node* node_ = nullptr;  // at hand
  std::array<Child, 2> children_;
  TreeCounts counts_;
  Cost lower_bound_ = 0;
  int failed_ = -1;
  // scratch
  std::span<const int> root_goals_;
  std::vector<int> pending_;  // robots to be planned for
  std::vector<RobotPlan> before_, merged_;
  std::vector<char> marked_;  // by robot
  std::vector<Constraint> root_constraints_;
  std::vector<Conflict> found_;
  FoundPath path_;
};

}  // namespace mrpbench::mapf
