#include "pibt.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "draws.hpp"

namespace mrpbench::discrete {

void Pibt::begin(const View& view) {
  const std::size_t robots = view.pose.size();
  if (priority_.size() != robots) {
    priority_.resize(robots);
    for (std::size_t i = 0; i < robots; ++i) priority_[i] = drawn_unit(seed_, i);
    intent_.assign(robots, -1);
    last_goal_ = view.goal;
    order_.resize(robots);
    std::iota(order_.begin(), order_.end(), 0);
    holder_.assign(view.grid.size(), -1);
    taker_.assign(view.grid.size(), -1);
  }
  wanted_.assign(robots, -1);
  for (std::size_t i = 0; i < robots; ++i) {
    // A robot without a goal gives way; one that has arrived loses the priority that it has gained.
    const double fraction = priority_[i] - static_cast<std::int64_t>(priority_[i]);
    priority_[i] = view.goal[i] < 0 || view.goal[i] != last_goal_[i] ? fraction : priority_[i] + 1;
    last_goal_[i] = view.goal[i];
    holder_[view.pose[i].cell] = static_cast<std::int32_t>(i);
    if (intent_[i] >= 0) {
      bool beside = false;
      for (int heading = 0; heading < 4; ++heading) beside |= view.grid.ahead(view.pose[i].cell, heading) == intent_[i];
      if (!beside) intent_[i] = -1;
    }
  }
}

bool Pibt::push(const View& view, int robot, int pusher) {
  const Pose pose = view.pose[robot];
  std::array<std::pair<std::uint32_t, int>, 5> choices;
  int count = 0;
  const int goal = view.goal[robot];
  const DistanceTable* const table = goal < 0 ? nullptr : &view.tables.to(goal);
  const std::uint32_t turn = view.tables.turn();
  for (int heading = 0; heading < 4; ++heading) {
    const int cell = view.grid.ahead(pose.cell, heading);
    if (cell < 0) continue;
    const int turns = heading == pose.heading ? 0 : ((heading ^ pose.heading) & 1) ? 1 : 2;
    std::uint32_t cost =
        table ? view.tables.forward({pose.cell, heading}) + table->from({cell, heading}) + turns * turn : 2u + turns;
    // Ties: an empty cell first, then one of this robot's own order, which no other robot shares.
    cost = 16 * cost + (holder_[cell] >= 0 ? 8 : 0) + static_cast<std::uint32_t>((robot + heading) & 3);
    choices[count++] = {intent_[robot] == cell ? 0 : cost + 1, cell};
  }
  choices[count++] = {table ? 16 * (table->from(pose) + 2 * turn) : 1u, pose.cell};
  for (int i = 1; i < count; ++i) {
    for (int k = i; k > 0 && choices[k] < choices[k - 1]; --k) std::swap(choices[k], choices[k - 1]);
  }
  for (int i = 0; i < count; ++i) {
    const int cell = choices[i].second;
    if (taker_[cell] >= 0) continue;
    const int other = holder_[cell];
    if (pusher >= 0 && cell == view.pose[pusher].cell) continue;
    if (other >= 0 && other != robot && wanted_[other] == pose.cell) continue;  // a swap
    taker_[cell] = robot;
    wanted_[robot] = cell;
    if (other >= 0 && other != robot && wanted_[other] < 0 && !push(view, other, robot)) {
      taker_[cell] = other;  // which stays
      continue;
    }
    return true;
  }
  wanted_[robot] = pose.cell;
  taker_[pose.cell] = robot;
  return false;
}

bool Pibt::moves(const View& view, int robot, std::vector<Action>& action) {
  if (settled_[robot] == 2) return action[robot] == Action::forward;
  if (settled_[robot] == 1) return !view.straight_following;  // a ring
  settled_[robot] = 1;
  const Pose pose = view.pose[robot];
  const int cell = wanted_[robot];
  Action chosen = Action::wait;
  if (cell != pose.cell) {
    int heading = 0;
    while (view.grid.ahead(pose.cell, heading) != cell) ++heading;
    if (heading == pose.heading) {
      const int other = holder_[cell];
      const bool line = other < 0 || !view.straight_following || view.pose[other].heading == heading;
      if (other < 0 || (line && moves(view, other, action))) chosen = Action::forward;
    } else {
      chosen = heading == ((pose.heading + 3) & 3) ? Action::counter_clockwise : Action::clockwise;
    }
  }
  action[robot] = chosen;
  settled_[robot] = 2;
  return chosen == Action::forward;
}

void Pibt::plan(const View& view, const Budget&, std::vector<Action>& action) {
  begin(view);
  const auto before = [&](int a, int b) {
    const bool kept_a = intent_[a] >= 0, kept_b = intent_[b] >= 0;
    return kept_a != kept_b ? kept_a : priority_[a] > priority_[b];
  };
  std::sort(order_.begin(), order_.end(), before);
  for (const int robot : order_) {
    if (wanted_[robot] < 0) push(view, robot, -1);
  }
  const std::size_t robots = view.pose.size();
  action.assign(robots, Action::wait);
  settled_.assign(robots, 0);
  for (std::size_t i = 0; i < robots; ++i) moves(view, static_cast<int>(i), action);
  for (std::size_t i = 0; i < robots; ++i) {
    const bool turning = action[i] == Action::clockwise || action[i] == Action::counter_clockwise;
    intent_[i] = turning ? wanted_[i] : -1;
    holder_[view.pose[i].cell] = -1;
    taker_[wanted_[i]] = -1;
  }
}

}  // namespace mrpbench::discrete
