#include "executor.hpp"

namespace mrpbench::discrete {

Executor::Executor(const Grid& grid, const std::vector<Pose>& start) : grid_(grid), last_(start) {
  staged_.resize(start.size());
  queue_.resize(grid.size());
  for (std::size_t i = 0; i < start.size(); ++i) queue_[start[i].cell].push_back(static_cast<std::int32_t>(i));
}

void Executor::stage(const std::vector<Action>& action) {
  for (std::size_t i = 0; i < action.size(); ++i) {
    if (action[i] == Action::wait) continue;
    staged_[i].push_back(action[i]);
    last_[i] = grid_.after(last_[i], action[i]);
    if (action[i] == Action::forward) queue_[last_[i].cell].push_back(static_cast<std::int32_t>(i));
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
  const auto& queue = queue_[target];
  const int first = queue.front();
  if (first == robot) return (go_[robot] = 1);
  const bool follows = queue[1] == robot && bodies.pose[first].cell == target && !staged_[first].empty() &&
                       staged_[first].front() == Action::forward && bodies.pose[first].heading == pose.heading &&
                       bodies.progress[first] >= bodies.progress[robot] && !delayed[first];
  return (go_[robot] = follows && ready(bodies, delayed, first));
}

void Executor::finish(int robot, const Pose& from) {
  if (staged_[robot].front() == Action::forward) queue_[from.cell].pop_front();
  staged_[robot].pop_front();
}

}  // namespace mrpbench::discrete
