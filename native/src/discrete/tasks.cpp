#include "mrpbench_discrete/tasks.hpp"

#include <algorithm>
#include <stdexcept>

namespace mrpbench::discrete {

Tasks::Tasks(const Problem& problem) : problem_(problem) {
  const std::size_t robots = problem.robots();
  of_robot_.assign(robots, -1);
  given_.assign(robots, 0);
  queue_.resize(robots);
  schedule_.resize(robots);
  if (problem.season == 2023) {
    for (std::size_t i = 0; i < robots; ++i) reveal_goals(0, static_cast<int>(i));
  } else {
    reveal(0);
  }
}

void Tasks::reveal(int time) {
  while (static_cast<int>(tasks_.size()) - finished_ < problem_.visible) {
    unopened_.push_back(static_cast<std::int32_t>(tasks_.size()));
    tasks_.push_back({static_cast<std::int32_t>(tasks_.size() % problem_.lines()), time});
  }
}

void Tasks::reveal_goals(int time, int robot) {
  auto& queue = queue_[robot];
  while (static_cast<int>(queue.size()) < problem_.visible) {
    const std::int64_t in_turn = static_cast<std::int64_t>(given_[robot]) * problem_.robots() + robot;
    const std::int64_t line = problem_.strategy == "greedy" ? drawn_ : in_turn;
    if (line >= problem_.lines() && problem_.strategy != "roundrobin") break;
    const auto task = static_cast<std::int32_t>(tasks_.size());
    tasks_.push_back({static_cast<std::int32_t>(line % problem_.lines()), time, 0, robot, robot});
    queue.push_back(task);
    events_.push_back({time, robot, task, 0});
    ++given_[robot];
    ++drawn_;
  }
  of_robot_[robot] = queue.empty() ? -1 : queue.front();
}

void Tasks::note(int time, int robot) {
  auto& entries = schedule_[robot];
  const std::int32_t task = of_robot_[robot];
  if (!entries.empty() && entries.back().first == time) entries.pop_back();
  if (entries.empty() || entries.back().second != task) entries.push_back({time, task});
}

std::string Tasks::fault(int time, int robot, int task) const {
  const int latest = problem_.season == 2024 ? time - 1 : time;
  if (task >= static_cast<int>(tasks_.size()) || tasks_[task].revealed > latest || done(task)) {
    return "task already finished";
  }
  const int opener = tasks_[task].opener;
  return opener >= 0 && opener != robot ? "task is already opened by robot " + std::to_string(opener) : "";
}

void Tasks::assign(int time, std::vector<std::int32_t> proposal) {
  if (proposal.size() != of_robot_.size()) {
    errors_.push_back({time, -1, -1, -1, "Invalid schedule size"});
    return;
  }
  const std::size_t before = errors_.size();
  std::vector<std::int32_t> taker(tasks_.size(), -1);
  for (std::size_t i = 0; i < proposal.size(); ++i) {
    const auto robot = static_cast<std::int32_t>(i);
    const int held = of_robot_[i];
    if (held >= 0 && open(held) && proposal[i] != held) {
      errors_.push_back({time, proposal[i], robot, -1, "the robot has to finish task " + std::to_string(held)});
      proposal[i] = held;
    }
    const int task = proposal[i];
    if (task < 0) continue;
    std::string text = fault(time, robot, task);
    int other = -1;
    if (text.empty() && taker[task] >= 0) {
      other = taker[task];
      text = "task is already assigned by the second agent at the same time";
    }
    if (text.empty()) {
      taker[task] = robot;
    } else {
      errors_.push_back({time, task, robot, other, text});
      proposal[i] = -1;
    }
  }
  if (problem_.season == 2024 && errors_.size() > before) return;
  for (std::size_t i = 0; i < proposal.size(); ++i) {
    if (of_robot_[i] >= 0) tasks_[of_robot_[i]].robot = -1;
  }
  for (std::size_t i = 0; i < proposal.size(); ++i) {
    of_robot_[i] = std::max(proposal[i], -1);
    if (of_robot_[i] >= 0) tasks_[of_robot_[i]].robot = static_cast<std::int32_t>(i);
    note(time, static_cast<int>(i));
  }
}

void Tasks::check(int time, const std::vector<Pose>& pose) {
  std::vector<std::int32_t> finishing;
  bool opened = false;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const int task = of_robot_[i];
    if (task < 0 || cell(task, tasks_[task].progress) != pose[i].cell) continue;
    const auto robot = static_cast<std::int32_t>(i);
    Task& it = tasks_[task];
    opened |= it.opener < 0;
    it.opener = robot;
    ++it.progress;
    ++errands_done_;
    events_.push_back({time, robot, task, it.progress});
    if (!done(task)) continue;
    ++finished_;
    of_robot_[i] = -1;
    finishing.push_back(robot);
    if (problem_.season == 2023) queue_[i].pop_front();
  }
  if (problem_.season == 2023) {
    for (const int robot : finishing) reveal_goals(time, robot);
    return;
  }
  if (opened) std::erase_if(unopened_, [&](int task) { return open(task); });
  reveal(time);
}

}  // namespace mrpbench::discrete
