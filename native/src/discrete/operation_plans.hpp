// Which operation each robot holds, and who is in which cell meanwhile.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mrpbench_discrete/planner.hpp"

namespace mrpbench::discrete {

constexpr int kDeepest = 5;
///< Actions of an operation, at most.

/// An operation of a robot, the cells at times 0, 1, …, depth, and what it is worth: less is better.
struct OperationPlan {
  std::array<Action, kDeepest> actions{};
  std::array<std::int32_t, kDeepest + 1> path{};
  std::int32_t value = 0;
};

class OperationPlans {
 public:
  static constexpr int nobody = -1, several = -2;

  OperationPlans(const View& view, int depth);

  /// Every robot waits where it is.
  void restart(const View& view);
  /// Take the plans of others of the same map and depth. The time does not depend on the size of the map.
  void copy(const OperationPlans& others);

  const OperationPlan& of(int robot) const { return plans_[robot]; }
  void place(int robot, const OperationPlan& plan);
  /// Free the cells of a robot, whose plan stays known.
  void remove(int robot);
  /// The robot whose operation excludes a plan, `nobody` or `several`.
  int hit(int robot, const OperationPlan& plan) const;

 private:
  void clear();
  void fill();

  const Grid* grid_;
  int depth_;
  bool straight_following_;
  std::vector<OperationPlan> plans_;
  std::vector<std::vector<std::int32_t>> at_;
};

}  // namespace mrpbench::discrete
