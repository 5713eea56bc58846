#include "operation_search.hpp"

namespace mrpbench::discrete {
namespace {

constexpr int kCalls = 3000;
///< Of `build` in one search.
constexpr int kTries = 4;
///< Of one robot in these calls: an operation that is not possible at once may be possible after the pusher's turn.

}  // namespace

bool OperationSearch::push(const Wishes& wishes, int robot, std::vector<std::uint8_t>& fixed) {
  fixed_ = &fixed;
  const bool found = begin(wishes, robot);
  for (const int it : changed_) fixed[it] = 1;
  return found;
}

bool OperationSearch::improve(const Wishes& wishes, int robot, double most) {
  fixed_ = nullptr;
  most_ = most;
  return begin(wishes, robot);
}

bool OperationSearch::begin(const Wishes& wishes, int robot) {
  ++stamp_;
  calls_ = 0;
  changed_.clear();
  return build(wishes, robot, 0, true);
}

/// Give a robot an operation, and others where it pushes. `spent` is the weighted value that the robots before it lose.
bool OperationSearch::build(const Wishes& wishes, int robot, double spent, bool first) {
  Visit& visit = visit_[robot];
  if (visit.stamp != stamp_) visit = {stamp_, 0, false};
  if (++calls_ > kCalls || visit.tries == kTries) return false;
  ++visit.tries;
  visit.pushing = true;
  const OperationPlan old = plans.of(robot);
  plans.remove(robot);
  for (const OperationPlan& choice : wishes.choices[robot]) {
    const double cost = spent + wishes.weight[robot] * (choice.value - old.value);
    if (fixed_ && first && choice.value >= old.value) break;
    const int other = plans.hit(robot, choice);
    if (other == OperationPlans::several) continue;
    if (other == OperationPlans::nobody) {
      if (!fixed_ && cost >= most_) break;  // what follows is worse
      plans.place(robot, choice);
      changed_.push_back(robot);
      return true;
    }
    if ((visit_[other].stamp == stamp_ && visit_[other].pushing) || (fixed_ && (*fixed_)[other])) continue;
    const OperationPlan others = plans.of(other);
    if (!fixed_) {
      const auto& of_other = wishes.choices[other];
      const double gain = of_other.empty() ? 0 : wishes.weight[other] * (others.value - of_other.front().value);
      if (cost - gain >= most_) continue;
    }
    plans.remove(other);
    plans.place(robot, choice);
    if (build(wishes, other, cost, false)) {
      changed_.push_back(robot);
      return true;
    }
    plans.remove(robot);
    plans.place(other, others);
    if (calls_ > kCalls) break;
  }
  plans.place(robot, old);
  visit.pushing = false;
  return false;
}

}  // namespace mrpbench::discrete
