// The constraint tree: best first over sets of constraints, the least sum of costs first.
// Sharon, Stern, Felner and Sturtevant, "Conflict-based search for optimal multi-agent pathfinding", AIJ 2015.
#pragma once

#include <optional>

#include "mrpbench_mapf/cbs/reasoning.hpp"

namespace mrpbench::mapf {

class Dependencies;

struct TreeCounts {
  std::int64_t expansions = 0;
  std::int64_t generated = 0;
  std::int64_t bypasses = 0;
};

class ConstraintTree {
 public:
  enum class Outcome { solved, exhausted, interrupted };

  /// With `dependencies`, nodes are ordered by what they must still cost.
  explicit ConstraintTree(Workbench& bench, Dependencies* dependencies = nullptr);

  /// Plan every robot on its own; the robot that has no path, or nothing.
  std::optional<int> start();
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
  };
  struct Open {
    Cost f;
    std::int32_t conflicts;
    Cost heuristic;
    std::int64_t id;
    Node* node;
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
  void gather(const Node& node);
  bool postpone(Node& node);
  Node* expand(Node& node);
  const Conflict& choose();
  Node* child(const Node& parent, std::span<const Constraint> constraints);
  bool replan_all(std::span<const Constraint> constraints);
  void replace(int robot, const TimedPath& path);
  bool is_changed(int robot) const;
  Node& complete(Node node);
  void push(Node& node);

  Workbench& bench_;
  Dependencies* dependencies_;
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
  std::vector<char> later_;         // by robot: was replanned farther down
  std::vector<Replanned> changed_;  // by the constraints of the child being made
  std::vector<TimedPath> before_;   // by robot: its path before that
  std::vector<Constraint> root_constraints_;
  std::vector<Conflict> found_;
  FoundPath path_;
};

}  // namespace mrpbench::mapf
