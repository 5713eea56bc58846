// Steps of 2023 and 2024: every action takes one step, and one fault anywhere makes all robots wait.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "guidance.hpp"
#include "mrpbench_discrete/league.hpp"
#include "scheduler.hpp"

namespace mrpbench::discrete {
namespace {

using Clock = std::chrono::steady_clock;

class Steps final : public League {
 public:
  Steps(Problem problem, LeagueOptions options) : League(std::move(problem), options), view_{problem_.grid, tables_} {
    const std::size_t robots = problem_.robots();
    view_.pose = pose_;
    view_.goal.assign(robots, -1);
    view_.next_goal.assign(robots, -1);
    view_.rest.assign(robots, 0);
    turns_.resize(robots);
    preprocess();
  }

  void run_until(int time) override {
    while (time_ < time) {
      const auto began = Clock::now();
      if (guidance_) guidance_->update();
      std::vector<std::int32_t> proposal;
      if (problem_.season == 2024) proposal = schedule();
      look(proposal);
      if (problem_.season == 2023) limit();
      const double spent = since(began);
      planner_->plan(view_, {0.9 * std::max(0.0, options_.limit_s - spent), options_.iterations}, action_);
      const double seconds = since(began);
      call_seconds_.push_back(seconds);
      if (!options_.iterations && seconds > options_.limit_s) {
        ++late_calls_;
        const int late = static_cast<int>(std::min(std::ceil(seconds / options_.limit_s) - 1, 1e6));
        for (int i = 0; i < late && time_ < time; ++i) {
          advance(std::vector<Action>(pose_.size(), Action::late));
        }
        if (time_ == time) return;
      }
      advance(action_, proposal);
    }
  }

 private:
  static double since(Clock::time_point began) { return std::chrono::duration<double>(Clock::now() - began).count(); }

  std::vector<std::int32_t> schedule() {
    const std::size_t robots = problem_.robots();
    std::vector<std::int32_t> proposal(robots), free, unbound;
    for (std::size_t i = 0; i < robots; ++i) {
      proposal[i] = tasks_.of(static_cast<int>(i));
      if (proposal[i] < 0) free.push_back(static_cast<std::int32_t>(i));
      if (proposal[i] < 0 || !tasks_.open(proposal[i])) unbound.push_back(static_cast<std::int32_t>(i));
    }
    const auto& tasks = tasks_.unopened();
    const bool all = Scheduler::reassigns(unbound.size(), tasks.size());
    if (!all && free.empty()) return proposal;
    std::vector<std::int32_t> given = tasks;
    if (!all) std::erase_if(given, [&](int task) { return tasks_.all()[task].robot >= 0; });
    const auto& robots_given = all ? unbound : free;
    const auto chosen = scheduler_->choose(tasks_, pose_, robots_given, given, may_get(robots - robots_given.size()));
    for (std::size_t i = 0; i < chosen.size(); ++i) proposal[robots_given[i]] = chosen[i];
    return proposal;
  }

  /// Set the goals of `view_`.
  void look(const std::vector<std::int32_t>& proposal) {
    view_.pose = pose_;
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      view_.goal[i] = view_.next_goal[i] = -1;
      view_.rest[i] = 0;
      const auto robot = static_cast<int>(i);
      if (problem_.season == 2023) {
        const auto& queue = tasks_.queue(robot);
        if (!queue.empty()) view_.goal[i] = tasks_.cell(queue[0], 0);
        if (queue.size() > 1) view_.next_goal[i] = tasks_.cell(queue[1], 0);
        continue;
      }
      const int task = proposal[i];
      if (task < 0) continue;
      const int errand = tasks_.all()[task].progress;
      view_.goal[i] = tasks_.cell(task, errand);
      if (errand + 1 < tasks_.errands(task)) view_.next_goal[i] = tasks_.cell(task, errand + 1);
      view_.rest[i] = scheduler_->rest(tasks_, task, errand);
    }
  }

  /// Leave goals to as many robots as are active. A robot keeps its turn until it reaches its goal. Next are robots
  /// with short ways and such that have waited long: two steps of waiting weigh as much as one of the way.
  void limit() {
    if (active_ >= pose_.size()) return;
    std::vector<std::pair<std::int64_t, std::size_t>> waiting;
    std::size_t active = 0;
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      const int goal = view_.goal[i];
      if (goal < 0) continue;
      const int task = tasks_.queue(static_cast<int>(i)).front();
      if (turns_[i].task != task) turns_[i] = {task, time_, false};
      if (turns_[i].active) {
        ++active;
        continue;
      }
      const std::int64_t way = tables_.to(goal).from(pose_[i]) / tables_.turn();
      waiting.push_back({2 * way - (time_ - turns_[i].since), i});
    }
    std::sort(waiting.begin(), waiting.end());
    const std::size_t next = may_get(active);
    for (std::size_t k = 0; k < waiting.size(); ++k) {
      const std::size_t robot = waiting[k].second;
      turns_[robot].active = k < next;
      if (k >= next) view_.goal[robot] = view_.next_goal[robot] = -1;
    }
  }

  /// One step, and the proposal that takes effect with it.
  void advance(const std::vector<Action>& action, const std::vector<std::int32_t>& proposal = {}) {
    ++time_;
    auto faults = faults_of_step(problem_.grid, pose_, action, time_);
    const bool moves = faults.empty();
    if (guidance_ && moves) guidance_->observe(pose_, action);
    errors_.insert(errors_.end(), std::make_move_iterator(faults.begin()), std::make_move_iterator(faults.end()));
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      const bool named = moves && (problem_.season == 2024 || action[i] != Action::late);
      record(action[i], named ? action[i] : Action::wait);
      if (moves) pose_[i] = problem_.grid.after(pose_[i], action[i]);
    }
    if (!proposal.empty()) tasks_.assign(time_, proposal);
    tasks_.check(time_, pose_);
  }

  View view_;
  std::vector<Action> action_;
  /// Whether a robot may go to the goal of its task, and since when it has that.
  struct Turn {
    std::int32_t task = -1;
    int since = 0;
    bool active = false;
  };
  std::vector<Turn> turns_;
};

}  // namespace

std::vector<ActionError> faults_of_step(const Grid& grid, const std::vector<Pose>& pose,
                                        const std::vector<Action>& action, int time) {
  if (action.size() != pose.size()) return {{time, -1, -1, "incorrect vector size"}};
  std::vector<ActionError> faults;
  std::vector<std::int32_t> before(grid.size(), -1), after(grid.size(), -1);
  std::vector<std::int32_t> onto(pose.size());
  for (std::size_t i = 0; i < pose.size(); ++i) before[pose[i].cell] = static_cast<std::int32_t>(i);
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const auto robot = static_cast<std::int32_t>(i);
    onto[i] = grid.after(pose[i], action[i]).cell;
    if (action[i] == Action::forward && grid.ahead(pose[i]) < 0) faults.push_back({time, robot, -1, "unallowed move"});
    if (after[onto[i]] >= 0) faults.push_back({time, after[onto[i]], robot, "vertex conflict"});
    after[onto[i]] = robot;
  }
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const int other = before[onto[i]];
    if (other > static_cast<int>(i) && onto[other] == pose[i].cell) {
      faults.push_back({time, static_cast<std::int32_t>(i), other, "edge conflict"});
    }
  }
  return faults;
}

std::unique_ptr<League> make_steps(Problem problem, LeagueOptions options) {
  return std::make_unique<Steps>(std::move(problem), std::move(options));
}

}  // namespace mrpbench::discrete
