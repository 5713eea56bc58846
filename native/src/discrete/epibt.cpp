#include "epibt.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "draws.hpp"

namespace mrpbench::discrete {
namespace {

constexpr int kUnit = 50;
///< Of value per unit of cost; below it operations of equal cost are told apart.
constexpr int kCalls = 3000;
///< Of `build` for one robot.
constexpr int kTries = 4;
///< Of one robot in these calls: an operation that is not possible at once may be possible after the pusher's turn.
constexpr std::uint64_t kPatience = 8, kTurn = 16;
///< A robot that has not come nearer for `kPatience` steps counts as nearer by a share that is drawn anew every `kTurn`
///< steps: robots that are in one another's way change places in the order, so that nobody waits for ever.
constexpr double kTemperature = 0.001, kCooling = 0.999;
constexpr int kNobody = -1, kSeveral = -2;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Epibt::Epibt(int depth, bool improve, std::uint64_t seed)
    : depth_(depth), improves_(improve), seed_(seed), operations_(operations(depth)) {
  if (depth < 3 || depth > kDeepest) throw std::invalid_argument("depth should be 3, 4 or 5");
}

void Epibt::plan(const View& view, const Budget& budget, std::vector<Action>& action) {
  const double began = now();
  inherit(view);
  rank(view);
  construct(view);
  if (improves_) improve(view, budget, began);
  const std::size_t robots = view.pose.size();
  action.resize(robots);
  for (std::size_t i = 0; i < robots; ++i) {
    action[i] = held_[i][0];
    expected_[i] = view.grid.after(view.pose[i], action[i]);
  }
}

void Epibt::inherit(const View& view) {
  const std::size_t robots = view.pose.size();
  const Operation waits(depth_, Action::wait);
  if (expected_ != view.pose) {  // the first step, or the last answer was not executed
    held_.assign(robots, waits);
    path_.resize(robots);
    value_.assign(robots, 0);
    last_goal_.resize(robots, -1);
    nearest_.resize(robots, 0);
    waited_.resize(robots, 0);
    expected_.resize(robots);
    choices_.resize(robots);
    visit_.assign(robots, {});
  } else {
    for (Operation& it : held_) {
      it.erase(it.begin());
      it.push_back(Action::wait);
    }
  }
  at_.assign(depth_ + 1, {});
  for (auto& layer : at_) layer.assign(view.grid.size(), -1);
  for (std::size_t i = 0; i < robots; ++i) {
    Path path{};
    path_of(view, static_cast<int>(i), held_[i], path);
    place(static_cast<int>(i), path);
    at_[0][view.pose[i].cell] = static_cast<std::int32_t>(i);
  }
}

void Epibt::rank(const View& view) {
  const std::size_t robots = view.pose.size();
  ++steps_;
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
  weight_.resize(robots);
  for (std::size_t rank = 0; rank < robots; ++rank) {
    const double share = 1 - static_cast<double>(rank) / static_cast<double>(robots);
    weight_[order_[rank]] = share * share;
  }
  known_.assign(robots, 0);
  for (std::size_t i = 0; i < robots; ++i) value_[i] = value(view, static_cast<int>(i), path_[i], 0);
}

bool Epibt::path_of(const View& view, int robot, const Operation& operation, Path& path) const {
  Pose pose = view.pose[robot];
  path[0] = pose.cell;
  for (int k = 0; k < depth_; ++k) {
    if (operation[k] == Action::forward && view.grid.ahead(pose) < 0) return false;
    pose = view.grid.after(pose, operation[k]);
    path[k + 1] = pose.cell;
  }
  return true;
}

/// Less is better. An operation that reaches the goal is better than any that does not; the sooner the better.
std::int32_t Epibt::value(const View& view, int robot, const Path& path, int operation) const {
  const int goal = view.goal[robot];
  if (goal < 0) {
    int moves = 0;
    for (int k = 0; k < depth_; ++k) moves += path[k] != path[k + 1];
    return kUnit * moves / 10;
  }
  for (int k = 1; k <= depth_; ++k) {
    if (path[k] != goal) continue;
    int onward = 0;
    if (const int next = view.next_goal[robot]; next >= 0) {
      const DistanceTable& table = view.tables.to(next);
      onward = static_cast<int>(table.from(path[depth_])) - static_cast<int>(table.from(goal));
    }
    return kUnit * (onward - 2 * depth_ * (depth_ - k + 1)) - operation;
  }
  return kUnit * static_cast<std::int32_t>(view.tables.to(goal).from(path[depth_])) - operation;
}

const std::vector<Epibt::Choice>& Epibt::choices(const View& view, int robot) {
  auto& found = choices_[robot];
  if (known_[robot]) return found;
  known_[robot] = 1;
  found.clear();
  Path path{};
  for (std::size_t i = 0; i < operations_.size(); ++i) {
    if (!path_of(view, robot, operations_[i], path)) continue;
    found.push_back({value(view, robot, path, static_cast<int>(i)), static_cast<std::int16_t>(i)});
  }
  std::sort(found.begin(), found.end(), [](const Choice& a, const Choice& b) {
    return a.value != b.value ? a.value < b.value : a.operation > b.operation;
  });
  return found;
}

void Epibt::place(int robot, const Path& path) {
  path_[robot] = path;
  for (int k = 1; k <= depth_; ++k) at_[k][path[k]] = robot;
}

void Epibt::remove(int robot) {
  for (int k = 1; k <= depth_; ++k) {
    if (at_[k][path_[robot][k]] == robot) at_[k][path_[robot][k]] = -1;
  }
}

/// The robot whose operation excludes this path, `kNobody` or `kSeveral`.
int Epibt::hit(const View& view, int robot, const Path& path) const {
  int found = kNobody;
  const auto meet = [&](int other) {
    if (other < 0 || other == robot || other == found) return true;
    if (found != kNobody) return false;
    found = other;
    return true;
  };
  for (int k = 1; k <= depth_; ++k) {
    const int from = path[k - 1], to = path[k];
    if (!meet(at_[k][to])) return kSeveral;
    if (from == to) continue;
    const int leaving = at_[k - 1][to];
    if (leaving >= 0 && leaving != robot) {
      const int onto = path_[leaving][k];
      bool clash = onto == from;
      if (view.straight_following && !clash) {
        int heading = 0;
        while (view.grid.ahead(from, heading) != to) ++heading;
        clash = onto != view.grid.ahead(to, heading);
      }
      if (clash && !meet(leaving)) return kSeveral;
    }
    if (view.straight_following) {
      const int entering = at_[k][from];
      if (entering >= 0 && entering != robot) {
        int heading = 0;
        while (view.grid.ahead(from, heading) != to) ++heading;
        if (path_[entering][k - 1] != view.grid.ahead(from, (heading + 2) & 3) && !meet(entering)) return kSeveral;
      }
    }
  }
  return found;
}

/// Give a robot an operation, and others where it pushes. `spent` is the weighted value that the robots before it lose.
bool Epibt::build(const View& view, int robot, double spent) {
  Visit& visit = visit_[robot];
  if (visit.stamp != stamp_) visit = {stamp_, 0, false};
  if (++calls_ > kCalls || visit.tries == kTries) return false;
  ++visit.tries;
  visit.pushing = true;
  const Path old_path = path_[robot];
  const std::int32_t old_value = value_[robot];
  remove(robot);
  Path path{};
  for (const Choice& choice : choices(view, robot)) {
    const double cost = spent + weight_[robot] * (choice.value - old_value) / kUnit;
    if (any_ && spent == 0 && choice.value >= old_value) break;  // the robot that pushes first wants something better
    path_of(view, robot, operations_[choice.operation], path);
    const int other = hit(view, robot, path);
    if (other == kSeveral) continue;
    if (other == kNobody) {
      if (!any_ && cost >= threshold_) break;  // what follows is worse
      place(robot, path);
      held_[robot] = operations_[choice.operation];
      value_[robot] = choice.value;
      fixed_[robot] = any_;
      return true;
    }
    if ((visit_[other].stamp == stamp_ && visit_[other].pushing) || (any_ && fixed_[other])) continue;
    if (!any_) {
      const auto& others = choices(view, other);
      const double most = others.empty() ? 0 : weight_[other] * (value_[other] - others.front().value) / kUnit;
      if (cost - most >= threshold_) continue;
    }
    const Path other_path = path_[other];
    remove(other);
    place(robot, path);
    const std::int32_t other_value = value_[other];
    // `other` is off the layers now; `build` restores nothing but its path, if it fails.
    value_[robot] = choice.value;
    if (build(view, other, any_ ? 1 : cost)) {
      held_[robot] = operations_[choice.operation];
      fixed_[robot] = any_;
      return true;
    }
    value_[robot] = old_value;
    value_[other] = other_value;
    remove(robot);
    place(other, other_path);
    path_[robot] = old_path;
    if (calls_ > kCalls) break;
  }
  place(robot, old_path);
  visit.pushing = false;
  return false;
}

void Epibt::construct(const View& view) {
  any_ = true;
  fixed_.assign(view.pose.size(), 0);
  for (const int robot : order_) {
    if (fixed_[robot]) continue;
    ++stamp_;
    calls_ = 0;
    // One that stays gives way to others, or two of them would wait for one another in a dead end.
    fixed_[robot] = build(view, robot, 0) || std::ranges::count(held_[robot], Action::forward) > 0;
  }
}

void Epibt::improve(const View& view, const Budget& budget, double began) {
  any_ = false;
  double temperature = kTemperature;
  const std::uint64_t robots = view.pose.size();
  for (std::int64_t i = 0; budget.iterations ? i < *budget.iterations : (i & 15) || now() - began < budget.seconds;
       ++i) {
    const std::uint64_t draw = drawn(seed_, ++draws_);
    const double unit = static_cast<double>(mixed(draw) >> 11) * 0x1p-53;
    threshold_ = -temperature * std::log(std::max(unit, 1e-300));
    temperature *= kCooling;
    ++stamp_;
    calls_ = 0;
    build(view, static_cast<int>(draw % robots), 0);
  }
}

}  // namespace mrpbench::discrete
