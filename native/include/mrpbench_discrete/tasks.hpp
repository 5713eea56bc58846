// Which robot has which task, what is done, and what is revealed.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "mrpbench_discrete/problem.hpp"

namespace mrpbench::discrete {

struct Task {
  std::int32_t line;
  std::int32_t revealed;
  std::int32_t progress = 0;
  std::int32_t opener = -1;
  std::int32_t robot = -1;
};

/// Time, robot, task, errands done; 0 errands: given to the robot (2023).
using Event = std::array<std::int32_t, 4>;
/// Time, task, robot, other robot.
struct ScheduleError {
  std::int32_t time, task, robot, other;
  std::string text;
};

class Tasks {
 public:
  explicit Tasks(const Problem& problem);

  /// Give robots tasks, -1 = none (2024, 2026). An invalid entry voids the whole proposal in 2024; in 2026 that entry
  /// alone.
  void assign(int time, std::vector<std::int32_t> proposal);
  /// See which errands are done at the end of a step or tick, and reveal what replaces finished tasks.
  void check(int time, const std::vector<Pose>& pose);

  const std::vector<Task>& all() const { return tasks_; }
  int of(int robot) const { return of_robot_[robot]; }
  bool open(int task) const { return tasks_[task].opener >= 0; }
  bool done(int task) const { return tasks_[task].progress == errands(task); }
  int errands(int task) const { return problem_.first[tasks_[task].line + 1] - problem_.first[tasks_[task].line]; }
  /// Cell of an errand of a task.
  int cell(int task, int errand) const { return problem_.errands[problem_.first[tasks_[task].line] + errand]; }
  /// The goals of a robot in 2023, by task.
  const std::deque<std::int32_t>& queue(int robot) const { return queue_[robot]; }
  /// Unfinished tasks that no robot has begun.
  const std::vector<std::int32_t>& unopened() const { return unopened_; }

  int finished() const { return finished_; }
  int errands_done() const { return errands_done_; }
  const std::vector<Event>& events() const { return events_; }
  const std::vector<ScheduleError>& errors() const { return errors_; }
  /// For each robot: since when it has which task.
  const std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>>& schedule() const { return schedule_; }

 private:
  void reveal(int time);
  void reveal_goals(int time, int robot);
  void note(int time, int robot);
  std::string fault(int time, int robot, int task) const;

  const Problem& problem_;
  std::vector<Task> tasks_;
  std::vector<std::int32_t> of_robot_, unopened_, given_;
  std::vector<std::deque<std::int32_t>> queue_;
  int drawn_ = 0, finished_ = 0, errands_done_ = 0;
  std::vector<Event> events_;
  std::vector<ScheduleError> errors_;
  std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> schedule_;
};

}  // namespace mrpbench::discrete
