// The search of EPIBT: a robot takes an operation, and pushes others that are in its way.
#pragma once

#include "operation_plans.hpp"

namespace mrpbench::discrete {

/// What the search knows of robots and does not change.
struct Wishes {
  /// Operations that each robot may take, the best ones first.
  std::vector<std::vector<OperationPlan>> choices;
  std::vector<double> weight;
  ///< Of each robot's value in sums over robots.
};

class OperationSearch {
 public:
  OperationSearch(const View& view, int depth) : plans(view, depth), visit_(view.pose.size()) {}

  /// Give a robot an operation that is better for it, whatever it is for others, but for robots that are `fixed`; all
  /// that take part become fixed. Returns false, and changes nothing, if there is none.
  bool push(const Wishes& wishes, int robot, std::vector<std::uint8_t>& fixed);
  /// Give robots operations, first of all this one, so that the weighted sum of values rises by less than `most`.
  /// Returns false, and changes nothing, if there are none. `changed` are the robots that take part.
  bool improve(const Wishes& wishes, int robot, double most);
  const std::vector<std::int32_t>& changed() const { return changed_; }

  OperationPlans plans;

 private:
  /// Of a robot in the search that has this stamp. `pushing`: it has, or is about to get, an operation that others make
  /// room for.
  struct Visit {
    std::uint64_t stamp = 0;
    int tries = 0;
    bool pushing = false;
  };

  bool begin(const Wishes& wishes, int robot);
  bool build(const Wishes& wishes, int robot, double spent, bool first);

  std::vector<Visit> visit_;
  std::vector<std::int32_t> changed_;
  std::uint64_t stamp_ = 0;
  int calls_ = 0;
  std::vector<std::uint8_t>* fixed_ = nullptr;
  ///< Null: values count.
  double most_ = 0;
};

}  // namespace mrpbench::discrete
