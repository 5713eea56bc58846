#include "epibt.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "draws.hpp"

namespace mrpbench::discrete {
namespace {

constexpr int kUnit = 50;
///< Of value per unit of cost; below it operations of equal cost are told apart.
constexpr std::uint64_t kPatience = 8, kTurn = 16;
///< A robot that has not come nearer for `kPatience` steps counts as nearer by a share that is drawn anew every `kTurn`
///< steps: robots that are in one another's way change places in the order, so that nobody waits for ever.

}  // namespace

Epibt::Epibt(int depth, bool improve, int threads, std::uint64_t seed)
    : depth_(depth), improves_(improve), seed_(seed), operations_(operations(depth)), lns_(threads, seed) {
  if (depth < 3 || depth > kDeepest) throw std::invalid_argument("depth should be 3, 4 or 5");
}

void Epibt::plan(const View& view, const Budget& budget, std::vector<Action>& action) {
  const double until = steady_seconds() + budget.seconds;
  ++steps_;
  inherit(view);
  rank(view);
  choose(view);
  construct();
  if (improves_) lns_.improve(wishes_, budget, until, steps_, *search_);
  const std::size_t robots = view.pose.size();
  action.resize(robots);
  for (std::size_t i = 0; i < robots; ++i) {
    held_[i] = search_->plans.of(static_cast<int>(i));
    action[i] = held_[i].actions[0];
    expected_[i] = view.grid.after(view.pose[i], action[i]);
  }
}

/// What is left of the operations that robots hold.
void Epibt::inherit(const View& view) {
  const std::size_t robots = view.pose.size();
  if (search_)
    search_->plans.restart(view);
  else
    search_.emplace(view, depth_);
  OperationPlans& plans = search_->plans;
  const bool executed = expected_ == view.pose;  // not in the first step, nor if the last answer was not executed
  expected_.resize(robots);
  held_.resize(robots);
  last_goal_.resize(robots, -1);
  nearest_.resize(robots, 0);
  waited_.resize(robots, 0);
  for (std::size_t i = 0; i < robots; ++i) plans.remove(static_cast<int>(i));
  for (std::size_t i = 0; i < robots; ++i) {
    auto& actions = held_[i].actions;
    if (executed)
      std::shift_left(actions.begin(), actions.end(), 1);
    else
      actions.fill(Action::wait);
    actions[depth_ - 1] = Action::wait;
    plans.place(static_cast<int>(i), *plan_of(view, static_cast<int>(i), {actions.data(), actions.size()}, 0));
  }
}

void Epibt::rank(const View& view) {
  const std::size_t robots = view.pose.size();
  std::vector<std::uint64_t> length(robots);
  for (std::size_t i = 0; i < robots; ++i) {
    const int goal = view.goal[i];
    if (goal != last_goal_[i]) {
      last_goal_[i] = goal;
      nearest_[i] = ~0u;
    }
    const std::uint32_t way = goal < 0 ? 0 : view.tables.to(goal).from(view.pose[i]);
    waited_[i] = way < nearest_[i] ? 0 : waited_[i] + 1;
    nearest_[i] = std::min(nearest_[i], way);
    const std::uint64_t whole = std::uint64_t{way} + view.rest[i];
    const double share = waited_[i] < kPatience ? 1 : drawn_unit(seed_, i, steps_ / kTurn);
    length[i] = goal < 0 ? ~0ull : static_cast<std::uint64_t>(share * static_cast<double>(whole));
  }
  order_.resize(robots);
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return length[a] < length[b]; });
  wishes_.weight.resize(robots);
  for (std::size_t rank = 0; rank < robots; ++rank) {
    const double share = 1 - static_cast<double>(rank) / static_cast<double>(robots);
    wishes_.weight[order_[rank]] = share / (kUnit * view.tables.turn());
  }
}

/// The operations of every robot, the best ones first.
void Epibt::choose(const View& view) {
  wishes_.choices.resize(view.pose.size());
  for (std::size_t i = 0; i < view.pose.size(); ++i) {
    auto& found = wishes_.choices[i];
    found.clear();
    for (std::size_t k = operations_.size(); k-- > 0;) {
      const auto plan = plan_of(view, static_cast<int>(i), operations_[k], static_cast<int>(k));
      if (plan) found.push_back(*plan);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const OperationPlan& a, const OperationPlan& b) { return a.value < b.value; });
  }
}

/// The plan of a robot that takes these actions, none if a wall is in the way.
std::optional<OperationPlan> Epibt::plan_of(const View& view, int robot, std::span<const Action> actions,
                                            int worth) const {
  OperationPlan plan;
  Pose pose = view.pose[robot];
  plan.path[0] = pose.cell;
  for (int k = 0; k < depth_; ++k) {
    if (actions[k] == Action::forward && view.grid.ahead(pose) < 0) return {};
    plan.actions[k] = actions[k];
    pose = view.grid.after(pose, actions[k]);
    plan.path[k + 1] = pose.cell;
  }
  plan.value = value(view, robot, plan, worth);
  return plan;
}

/// Less is better. An operation that reaches the goal is better than any that does not; the sooner the better.
std::int32_t Epibt::value(const View& view, int robot, const OperationPlan& plan, int worth) const {
  const auto& path = plan.path;
  const int goal = view.goal[robot], step = static_cast<int>(view.tables.turn());
  if (goal < 0) {
    int moves = 0;
    for (int k = 0; k < depth_; ++k) moves += path[k] != path[k + 1];
    return kUnit * step * moves / 10;
  }
  for (int k = 1; k <= depth_; ++k) {
    if (path[k] != goal) continue;
    int onward = 0;
    if (const int next = view.next_goal[robot]; next >= 0) {
      const DistanceTable& table = view.tables.to(next);
      onward = static_cast<int>(table.from(path[depth_])) - static_cast<int>(table.from(goal));
    }
    return kUnit * (onward - step * 2 * depth_ * (depth_ - k + 1)) - step * worth;
  }
  return kUnit * static_cast<std::int32_t>(view.tables.to(goal).from(path[depth_])) - step * worth;
}

void Epibt::construct() {
  std::vector<std::uint8_t> fixed(order_.size(), 0);
  for (const int robot : order_) {
    if (fixed[robot]) continue;
    // One that stays gives way to others, or two of them would wait for one another in a dead end.
    const bool found = search_->push(wishes_, robot, fixed);
    fixed[robot] = found || std::ranges::count(search_->plans.of(robot).actions, Action::forward) > 0;
  }
}

}  // namespace mrpbench::discrete
