// The constraint tree of bounded-suboptimal conflict-based search, with the parts of the optimal one (`cbs/`). Robots
// go to any of their goals; or each root of a forest sends them elsewhere (ECBS-TA: Hoenig, Kiesel, Tinka, Durham and
// Ayanian, "Conflict-based search with optimal task assignment", AAMAS 2018); or each node does (Tang, Koenig and Li,
// "ITA-ECBS: a bounded-suboptimal algorithm for the combined target-assignment and path-finding problem", SoCS 2024).
#pragma once

#include "mrpbench_mapf/bounded/focal_search.hpp"
#include "mrpbench_mapf/bounded/incumbent.hpp"
#include "mrpbench_mapf/bounded/node_queue.hpp"
#include "mrpbench_mapf/cbs/dependencies.hpp"

namespace mrpbench::mapf {

class BoundedTree {
 public:
  BoundedTree(Workbench& bench, const BoundedOptions& options, Result& result);

  void solve();

 private:
  /// The path of a robot, and the least cost of any that its constraints allow.
  struct Plan {
    std::int32_t robot;
    Tick least;
    TimedPath path;
  };
  /// A node of the constraint tree, as what differs from its parent; but it lists all conflicts.
  struct Node {
    const Node* parent = nullptr;
    std::span<const Constraint> constraints;
    std::span<const Plan> plans;
    std::span<Conflict* const> conflicts;
    Cost cost = 0, least = 0;
    Cost heuristic = 0;      // what pairs of robots add to `least`
    bool evaluated = false;  // `heuristic` is more than what it inherits
    const NodeAssignment::Record* assignment = nullptr;

    std::int32_t conflict_count() const { return static_cast<std::int32_t>(conflicts.size()); }
  };
  /// A node being made.
  struct Child {
    bool possible = false;
    Cost cost = 0, least = 0;
    std::span<const Constraint> constraints;
    std::vector<Plan> plans;
    std::vector<Conflict*> conflicts;
    const NodeAssignment::Record* assignment = nullptr;
  };

  void start();
  bool make_root(std::span<const int> goals);
  void make_ranked_root();
  void announce_root();
  bool finish_aside();
  void finish();
  void push(const Node* parent, const Child& child);
  void enqueue(std::int32_t id);
  double estimate(Cost cost, std::size_t conflicts) const {
    return errors_.estimate(cost, static_cast<std::int32_t>(conflicts));
  }
  void visit(const Node& node);
  void replace(const Plan& plan);
  bool postpone(std::int32_t id);
  void expand(Node& node);
  Conflict& choose(Node& node);
  void examine(Node& node, Conflict& conflict);
  void tighten(Node& node, int robot);
  void branch_into_children(const Node& node);
  void plan_child(const Node& parent, Child& child);
  bool replan(Child& child);
  int goal_of(int robot) const;
  bool is_settled(int robot, int goal, const Child& child) const;
  void ask_for(int robot, std::size_t asked);
  void keep(Child& child, const Plan& plan);
  void take_up(const Node& node);
  void find_conflicts(int robot, const TimedPath& path, std::vector<Conflict*>& conflicts);
  bool bypass(Node& node, const Child& child);
  void add_plan(Node& node, const Plan& plan);

  Workbench& bench_;
  const BoundedOptions& options_;
  Limits& limits_;
  Result& result_;
  int robots_;
  OnlineErrors errors_;
  NodeQueue queue_;
  FocalSearch search_;
  Situation situation_;  // of the node at hand
  AvoidanceTable present_;
  Arena<Node> nodes_;
  Arena<Plan> plans_;
  Arena<Constraint> constraints_;
  Arena<Conflict> conflicts_;
  Arena<Conflict*> conflict_lists_;
  PathStore paths_;
  Reasoning reasoning_;
  Dependencies dependencies_;
  std::int64_t root_effort_ = 0;  // low-level expansions for the first node
  std::optional<Incumbent> incumbent_;
  std::optional<NodeAssignment> assignment_;
  std::optional<RankedGoals> ranked_;
  std::optional<RankedGoals::Ranked> next_root_;
  std::vector<Node*> by_id_;  // null: the next root, not yet made
  std::size_t counted_ = 0;
  std::vector<Plan> current_;  // by robot
  std::array<Child, 2> children_;
  // scratch
  std::span<const int> root_goals_;
  std::vector<int> pending_;  // robots to be planned for
  int failed_ = -1;           // robot without a path
  std::vector<Plan> wanted_, before_;
  std::vector<char> later_;
  std::vector<Conflict> found_;
  FoundPath path_;
};

}  // namespace mrpbench::mapf
