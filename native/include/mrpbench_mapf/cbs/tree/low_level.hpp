// The search for the path of one robot in a node of a constraint tree.
#pragma once

#include "mrpbench_mapf/cbs/low_level/search_context.hpp"

namespace mrpbench::mapf {

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

class LowLevel {
 public:
  virtual ~LowLevel() = default;
  /// Write a path of `robot` to `goal` that keeps to what binds it in `state` and to `more` into `path`. The result
  /// is a lower bound on the cost of all such paths, at least `known`, which must be one; kForever: there is none.
  /// `present` has the paths of the other robots, which have `others` in sum.
  virtual Tick plan(const NodeState& state, int robot, int goal, std::span<const Constraint> more,
                    const AvoidanceTable& present, Tick known, const Sums& others, FoundPath& path) = 0;
  /// Do all paths cost as much as their lower bounds?
  virtual bool is_optimal() const = 0;
  /// May a node with the paths in `state` take over the `plans` of its child, which has fewer conflicts?
  virtual bool allows_bypass(const NodeState& state, const Sums& node, const Sums& child,
                             std::span<const RobotPlan> plans) const = 0;
};

/// The cheapest path, by `SpaceTimeAstar`.
class OptimalSearch final : public LowLevel {
 public:
  explicit OptimalSearch(SearchContext& context) : context_(context) {}

  Tick plan(const NodeState& state, int robot, int goal, std::span<const Constraint> more,
            const AvoidanceTable& present, Tick /*known*/, const Sums& /*others*/, FoundPath& path) override {
    return context_.plan(state, robot, goal, more, &present, path) ? path.cost : kForever;
  }
  bool is_optimal() const override { return true; }
  bool allows_bypass(const NodeState& /*state*/, const Sums& node, const Sums& child,
                     std::span<const RobotPlan> /*plans*/) const override {
    return child.cost == node.cost;
  }

 private:
  SearchContext& context_;
};

}  // namespace mrpbench::mapf
