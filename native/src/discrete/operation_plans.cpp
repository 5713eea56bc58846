#include "operation_plans.hpp"

namespace mrpbench::discrete {

OperationPlans::OperationPlans(const View& view, int depth)
    : grid_(&view.grid), depth_(depth), straight_following_(view.straight_following) {
  at_.assign(depth + 1, std::vector<std::int32_t>(view.grid.size(), nobody));
  restart(view);
}

void OperationPlans::restart(const View& view) {
  clear();
  plans_.resize(view.pose.size());
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    plans_[i] = {};
    plans_[i].actions.fill(Action::wait);
    plans_[i].path.fill(view.pose[i].cell);
  }
  fill();
}

void OperationPlans::copy(const OperationPlans& others) {
  clear();
  plans_ = others.plans_;
  fill();
}

void OperationPlans::clear() {
  for (const OperationPlan& plan : plans_) {
    for (int k = 0; k <= depth_; ++k) at_[k][plan.path[k]] = nobody;
  }
}

void OperationPlans::fill() {
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    for (int k = 0; k <= depth_; ++k) at_[k][plans_[i].path[k]] = static_cast<std::int32_t>(i);
  }
}

void OperationPlans::place(int robot, const OperationPlan& plan) {
  plans_[robot] = plan;
  for (int k = 1; k <= depth_; ++k) at_[k][plan.path[k]] = robot;
}

void OperationPlans::remove(int robot) {
  for (int k = 1; k <= depth_; ++k) {
    std::int32_t& holder = at_[k][plans_[robot].path[k]];
    if (holder == robot) holder = nobody;
  }
}

int OperationPlans::hit(int robot, const OperationPlan& plan) const {
  int found = nobody;
  const auto meet = [&](int other) {
    if (other < 0 || other == robot || other == found) return true;
    if (found != nobody) return false;
    found = other;
    return true;
  };
  for (int k = 1; k <= depth_; ++k) {
    const int from = plan.path[k - 1], to = plan.path[k];
    if (!meet(at_[k][to])) return several;
    if (from == to) continue;
    const int leaving = at_[k - 1][to], entering = straight_following_ ? at_[k][from] : nobody;
    int heading = 0;
    if (straight_following_) {
      while (grid_->ahead(from, heading) != to) ++heading;
    }
    if (leaving >= 0 && leaving != robot) {
      const int onto = plans_[leaving].path[k];
      const bool clash = onto == from || (straight_following_ && onto != grid_->ahead(to, heading));
      if (clash && !meet(leaving)) return several;
    }
    if (entering >= 0 && entering != robot) {
      const bool clash = plans_[entering].path[k - 1] != grid_->ahead(from, (heading + 2) & 3);
      if (clash && !meet(entering)) return several;
    }
  }
  return found;
}

}  // namespace mrpbench::discrete
