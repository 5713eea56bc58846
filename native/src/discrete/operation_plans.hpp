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

  /// Every robot waits where it is.
  OperationPlans(const View& view, int depth);

  const OperationPlan& of(int robot) const { return plans_[robot]; }
  void place(int robot, const OperationPlan& plan);
  /// Free the cells of a robot, whose plan stays known.
  void remove(int robot);
  /// The robot whose operation excludes a plan, `nobody` or `several`.
  int hit(int robot, const OperationPlan& plan) const;

 private:
  const Grid* grid_;
  int depth_;
  bool straight_following_;
  std::vector<OperationPlan> plans_;
  std::vector<std::vector<std::int32_t>> at_;
};

}  // namespace mrpbench::discrete
