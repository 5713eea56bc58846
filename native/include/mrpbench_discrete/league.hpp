// Discrete executions by the rules of the League of Robot Runners: steps (2023, 2024) and ticks (2026).
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mrpbench_discrete/planner.hpp"
#include "mrpbench_discrete/tasks.hpp"

namespace mrpbench::discrete {

struct LeagueOptions {
  PlannerOptions planner;
  /// Time for one answer of the planner and the scheduler.
  double limit_s = 1;
  /// If given, answers are never late and do not depend on the clock.
  std::optional<std::int64_t> iterations;
  std::uint64_t seed = 0;
  /// Of distance tables, at most.
  std::size_t table_bytes = std::size_t{2} << 30;
  /// Time before the first step, in which distance tables are computed, unless `iterations` is given.
  double preprocessing_s = 30;
  /// Whether moves cost more where there is traffic.
  bool guidance = true;
  /// Robots that have a goal at the same time, at most; none: half as many as there are free cells,
  /// in 2023 three eighths.
  std::optional<int> active;
  /// 2026: ticks between two calls of the planner.
  int period = 10;
};

/// Time, robot, other robot (-1 = none), text.
struct ActionError {
  std::int32_t time, robot, other;
  std::string text;
};

class Guidance;
class Scheduler;

/// What both kinds of execution share.
class League {
 public:
  League(Problem problem, LeagueOptions options);
  virtual ~League();
  League(const League&) = delete;
  League& operator=(const League&) = delete;

  /// Advance to the end of the given step or tick.
  virtual void run_until(int time) = 0;

  int time() const { return time_; }
  const Problem& problem() const { return problem_; }
  const Tasks& tasks() const { return tasks_; }
  const std::vector<Pose>& pose() const { return pose_; }
  /// Letters, one row of all robots per step or tick.
  const std::vector<std::uint8_t>& letters() const { return letters_; }
  /// Row of `letters`, robot and letter of each action that was asked for and did not happen.
  const std::vector<std::array<std::int32_t, 3>>& unexecuted() const { return unexecuted_; }
  const std::vector<ActionError>& errors() const { return errors_; }
  /// Seconds of each call of scheduler and planner.
  const std::vector<double>& call_seconds() const { return call_seconds_; }
  int late_calls() const { return late_calls_; }
  /// Seconds that the preprocessing took.
  double preprocessing_seconds() const { return preprocessing_seconds_; }

 protected:
  /// How many robots may get tasks, if `holding` others have some.
  std::size_t may_get(std::size_t holding) const { return std::max(active_, holding) - holding; }
  /// Compute the tables that the first answers need. Call it before the first one.
  void preprocess();
  /// Write down what a robot does; the robots come in order.
  void record(Action asked, Action done);

  Problem problem_;
  LeagueOptions options_;
  std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
  std::size_t active_ = 0;
  DistanceTables tables_;
  std::unique_ptr<Guidance> guidance_;
  ///< Null: none.
  Tasks tasks_;
  std::unique_ptr<Scheduler> scheduler_;
  std::unique_ptr<Planner> planner_;
  std::vector<Pose> pose_;
  std::vector<std::uint8_t> letters_;
  std::vector<std::array<std::int32_t, 3>> unexecuted_;
  std::vector<ActionError> errors_;
  std::vector<double> call_seconds_;
  int time_ = 0, late_calls_ = 0;
  double preprocessing_seconds_ = 0;

 private:
  std::vector<std::int32_t> first_goals();
};

/// 2023 and 2024.
std::unique_ptr<League> make_steps(Problem problem, LeagueOptions options);

/// The action that moves each robot, or the errors that make all of them wait: steps of 2023 and 2024.
std::vector<ActionError> faults_of_step(const Grid& grid, const std::vector<Pose>& pose,
                                        const std::vector<Action>& action, int time);

/// 2026.
class Ticks : public League {
 public:
  using League::League;
  virtual const std::vector<std::vector<std::array<std::int32_t, 2>>>& delays() const = 0;
  /// Row, column, heading, counter of every robot at every hundredth tick.
  virtual const std::vector<std::int32_t>& segments() const = 0;
  virtual int refused() const = 0;
};
std::unique_ptr<Ticks> make_ticks(Problem problem, LeagueOptions options);

}  // namespace mrpbench::discrete
