#include "executor.hpp"

namespace mrpbench::discrete {

void CellQueues::push(int cell, std::int32_t robot) {
  auto link = static_cast<std::int32_t>(links_.size());
  if (unused_.empty()) {
    links_.push_back({robot, -1});
  } else {
    link = unused_.back();
    unused_.pop_back();
    links_[link] = {robot, -1};
  }
  auto& [front, back] = ends_[cell];
  (front < 0 ? front : links_[back].next) = link;
  back = link;
}

void CellQueues::pop(int cell) {
  std::int32_t& front = ends_[cell][0];
  unused_.push_back(front);
  front = links_[front].next;
}

Executor::Executor(const Grid& grid, const std::vector<Pose>& start)
    : grid_(grid), last_(start), staged_(start.size()), queue_(grid.size()) {
  for (std::size_t i = 0; i < start.size(); ++i) queue_.push(start[i].cell, static_cast<std::int32_t>(i));
}

void Executor::stage(const std::vector<Action>& action) {
  for (std::size_t i = 0; i < action.size(); ++i) {
    if (action[i] == Action::wait) continue;
    staged_[i].push_back(action[i]);
    last_[i] = grid_.after(last_[i], action[i]);
    if (action[i] == Action::forward) queue_.push(last_[i].cell, static_cast<std::int32_t>(i));
  }
}

const std::vector<std::uint8_t>& Executor::go(const Bodies& bodies, const std::vector<std::uint8_t>& delayed_before) {
  go_.assign(staged_.size(), 0);
  known_.assign(staged_.size(), 0);
  for (std::size_t i = 0; i < staged_.size(); ++i) ready(bodies, delayed_before, static_cast<int>(i));
  return go_;
}

bool Executor::ready(const Bodies& bodies, const std::vector<std::uint8_t>& delayed, int robot) {
  if (known_[robot]) return go_[robot];
  known_[robot] = 1;
  if (staged_[robot].empty()) return false;
  if (staged_[robot].front() != Action::forward) return (go_[robot] = 1);
  const Pose pose = bodies.pose[robot];
  const int target = grid_.ahead(pose);
  const int first = queue_.first(target);
  if (first == robot) return (go_[robot] = 1);
  const bool follows = queue_.second(target) == robot && bodies.pose[first].cell == target && !staged_[first].empty() &&
                       staged_[first].front() == Action::forward && bodies.pose[first].heading == pose.heading &&
                       bodies.progress[first] >= bodies.progress[robot] && !delayed[first];
  return (go_[robot] = follows && ready(bodies, delayed, first));
}

void Executor::finish(int robot, const Pose& from) {
  if (staged_[robot].front() == Action::forward) queue_.pop(from.cell);
  staged_[robot].pop_front();
}

}  // namespace mrpbench::discrete
