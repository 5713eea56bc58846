// The constraint tree: best first over sets of constraints, the least sum of costs first.
// Sharon, Stern, Felner and Sturtevant, "Conflict-based search for optimal multi-agent pathfinding", AIJ 2015.
// Robots go to any of their goals; or each root of a forest sends them elsewhere (Hoenig, Kiesel, Tinka, Durham and
// Ayanian, "Conflict-based search with optimal task assignment", AAMAS 2018); or each node does (Tang, Ren, Li and
// Sycara, MRS 2023, see `NodeAssignment`).
#pragma once

#include <optional>

#include "mrpbench_mapf/assignment/node_assignment.hpp"
#include "mrpbench_mapf/cbs/reasoning.hpp"

namespace mrpbench::mapf {

class Dependencies;

struct TreeCounts {
  std::int64_t expansions = 0;
  std::int64_t generated = 0;
  std::int64_t bypasses = 0;
  std::int64_t roots = 0;
};

class ConstraintTree {
 public:
  enum class Outcome { solved, exhausted, interrupted };

  /// With `dependencies`, nodes are ordered by what they must still cost.
  explicit ConstraintTree(Workbench& bench, Dependencies* dependencies = nullptr);

  /// Plan every robot on its own; the robot that has no path, or nothing.
  std::optional<int> start();
  /// A forest: a root for the first goals, and for the next ones when all nodes cost as much.
  void start(RankedGoals& ranked);
  /// Goals by the constraints of each node, from the first assignment on. False if there is no solution.
  bool start(NodeAssignment& assignment);
  /// Begin with the cheapest paths of two robots in `situation`, which must exist.
  void start(const Situation& situation, int one, int other);
  /// Search until there is a solution, there can be none, or more than `expansions` nodes were expanded.
  Outcome run(std::int64_t expansions);

  /// No solution costs less.
  Cost lower_bound() const { return lower_bound_; }
  const TreeCounts& counts() const { return counts_; }
  /// The paths of the node that was looked at last: once solved, the solution.
  const Situation& situation() const { return situation_; }

 private:
  struct Replanned {
    std::int32_t robot;
    TimedPath path;
  };
  /// A node stores what differs from its parent.
  struct Node {
    const Node* parent;
    std::span<const Constraint> constraints;
    std::span<const Replanned> replanned;
    std::span<Conflict> conflicts;  // of robots that were replanned
    Cost cost;
    Cost heuristic;
    std::int32_t conflict_count;  // of all robots
    bool evaluated;               // `heuristic` is more than what it inherits
    const NodeAssignment::Record* assignment;
  };
  struct Open {
    Cost f;
    std::int32_t conflicts;
    Cost heuristic;
    std::int64_t id;
    Node* node;  // null: the next root, not yet made
    bool operator>(const Open& other) const {
      if (f != other.f) return f > other.f;
      if (conflicts != other.conflicts) return conflicts > other.conflicts;
      if (heuristic != other.heuristic) return heuristic > other.heuristic;
      return id < other.id;
    }
  };

  void clear();
  TimedPath cheapest_path(const Situation& situation, int robot);
  void begin_with(int robot, const TimedPath& path);
  Node* make_root(std::span<const int> goals);
  void make_ranked_root();
  void announce_root(std::int32_t conflicts);
  void gather(const Node& node);
  bool postpone(Node& node);
  Node* expand(Node& node);
  const Conflict& choose();
  Node* child(const Node& parent, std::span<const Constraint> constraints);
  bool replan(std::span<const Constraint> constraints);
  int goal_of(int robot) const;
  bool is_settled(int robot, int goal, std::span<const Constraint> constraints) const;
  void ask_for(int robot, std::size_t asked);
  void keep(int robot, const TimedPath& path);
  void take_up(const Node& node);
  void replace(int robot, const TimedPath& path);
  bool is_changed(int robot) const;
  Node& complete(Node node);
  void push(Node& node);

  Workbench& bench_;
  Dependencies* dependencies_;
  NodeAssignment* assignment_ = nullptr;
  RankedGoals* ranked_ = nullptr;
  std::optional<RankedGoals::Ranked> next_root_;
  std::vector<TimedPath> root_paths_;  // by robot: in the last ranked root
  std::vector<int> robots_;
  Situation situation_;
  AvoidanceTable others_;
  std::vector<Conflict*> present_;  // conflicts of the node at hand
  Arena<Node> nodes_;
  Arena<Constraint> constraints_;
  Arena<Conflict> conflicts_;
  Arena<Replanned> replanned_;
  Reasoning reasoning_;
  PathStore paths_;
  std::vector<Open> open_;
  TreeCounts counts_;
  std::int64_t number_ = 0;  // of nodes that were put into `open_`
  Cost lower_bound_ = 0;
  std::size_t counted_ = 0;
  // scratch
  std::span<const int> root_goals_;
  std::vector<int> pending_;        // robots to be planned for
  int failed_ = -1;                 // robot without a path
  std::vector<char> later_;         // by robot: was replanned farther down
  std::vector<Replanned> changed_;  // by the constraints of the child being made
  std::vector<TimedPath> before_;   // by robot: its path before that
  std::vector<Constraint> root_constraints_;
  std::vector<Conflict> found_;
  FoundPath path_;
};

}  // namespace mrpbench::mapf
