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

constexpr std::size_t kReassigned = 4'000'000;
///< Pairs of robots and tasks up to which tasks that nobody has begun are given again in every step.

class Steps final : public League {
 public:
  Steps(Problem problem, LeagueOptions options)
      : League(std::move(problem), options), scheduler_(problem_, tables_), view_{problem_.grid, tables_} {
    const std::size_t robots = problem_.robots();
    view_.pose = pose_;
    view_.goal.assign(robots, -1);
    view_.next_goal.assign(robots, -1);
    view_.rest.assign(robots, 0);
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
          advance(std::vector<Action>(pose_.size(), problem_.season == 2024 ? Action::late : Action::wait));
        }
        if (time_ == time) return;
      }
      advance(action_, proposal);
      tables_.forget();
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
    const bool all = unbound.size() * tasks.size() <= kReassigned;
    if (!all && free.empty()) return proposal;
    std::vector<std::int32_t> given = tasks;
    if (!all) std::erase_if(given, [&](int task) { return tasks_.all()[task].robot >= 0; });
    const auto& robots_given = all ? unbound : free;
    const auto chosen = scheduler_.choose(tasks_, pose_, robots_given, given, may_get(robots - robots_given.size()));
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
      view_.rest[i] = scheduler_.rest(tasks_, task, errand);
    }
  }

  /// Leave goals to the robots that are nearest to theirs.
  void limit() {
    if (active_ >= pose_.size()) return;
    std::vector<std::pair<std::uint32_t, std::size_t>> ways;
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      if (view_.goal[i] >= 0) ways.push_back({tables_.to(view_.goal[i]).from(pose_[i]), i});
    }
    std::sort(ways.begin(), ways.end());
    for (std::size_t k = active_; k < ways.size(); ++k)
      view_.goal[ways[k].second] = view_.next_goal[ways[k].second] = -1;
  }

  /// One step, and the proposal that takes effect with it.
  void advance(const std::vector<Action>& action, const std::vector<std::int32_t>& proposal = {}) {
    ++time_;
    auto faults = faults_of_step(problem_.grid, pose_, action, time_);
    const bool moves = faults.empty();
    if (guidance_ && moves) guidance_->observe(pose_, action);
    errors_.insert(errors_.end(), std::make_move_iterator(faults.begin()), std::make_move_iterator(faults.end()));
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      letters_.push_back(static_cast<std::uint8_t>(moves ? action[i] : Action::wait));
      if (moves) pose_[i] = problem_.grid.after(pose_[i], action[i]);
    }
    if (!proposal.empty()) tasks_.assign(time_, proposal);
    tasks_.check(time_, pose_);
  }

  Scheduler scheduler_;
  View view_;
  std::vector<Action> action_;
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

League::League(Problem problem, LeagueOptions options)
    : problem_(std::move(problem)),
      options_(std::move(options)),
      tables_(problem_.grid, options_.table_bytes),
      tasks_(problem_),
      planner_(make_planner(options_.planner, options_.seed)) {
  for (const int cell : problem_.start) pose_.push_back({cell, 0});
  if (options_.guidance) guidance_ = std::make_unique<Guidance>(problem_.grid, tables_);
  active_ = options_.active ? *options_.active : std::max(1, problem_.grid.size() / 2);
}

League::~League() = default;

std::unique_ptr<League> make_steps(Problem problem, LeagueOptions options) {
  return std::make_unique<Steps>(std::move(problem), std::move(options));
}

}  // namespace mrpbench::discrete
