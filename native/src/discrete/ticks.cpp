// Ticks of 2026: actions of several ticks, delays, and a planner that works beside the execution.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "delays.hpp"
#include "executor.hpp"
#include "guidance.hpp"
#include "mrpbench_discrete/league.hpp"
#include "scheduler.hpp"
#include "squares.hpp"

namespace mrpbench::discrete {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kTick = 0.1;
///< Seconds.
constexpr int kSegment = 100;
///< Ticks between states that outputs name.
constexpr double kSlack = 1.0;
///< Steps that robots should have left when the next plan comes.

class TickLeague final : public Ticks {
 public:
  TickLeague(Problem problem, LeagueOptions options)
      : Ticks(std::move(problem), options),
        executor_(problem_.grid, pose_),
        squares_(problem_.grid, problem_.size, problem_.counter),
        delays_(problem_.delays, pose_.size()),
        view_{problem_.grid, tables_} {
    const std::size_t robots = problem_.robots();
    bodies_ = {pose_, std::vector<Action>(robots, Action::wait), std::vector<std::int32_t>(robots, 0)};
    delayed_.assign(robots, 0);
    view_.straight_following = true;
    view_.goal.assign(robots, -1);
    view_.next_goal.assign(robots, -1);
    view_.rest.assign(robots, 0);
    preprocess();
    call(0);
    first_ = ready_at_ = std::max(ready_at_, options_.period);
  }

  void run_until(int time) override {
    for (; time_ < time; ++time_) {
      if (time_ % kSegment == 0) note_states();
      if (time_ < first_) {  // nothing moves before there is a plan
        for (std::size_t i = 0; i < pose_.size(); ++i) record(Action::late, Action::wait);
        continue;
      }
      if ((time_ - first_) % options_.period == 0 && time_ >= ready_at_) {
        take();
        call(time_);
      }
      tick();
    }
  }

  const std::vector<std::vector<std::array<std::int32_t, 2>>>& delays() const override { return delays_.intervals(); }
  const std::vector<std::int32_t>& segments() const override { return segments_; }
  int refused() const override { return refused_; }

 private:
  /// Where a robot will be after what is staged, and what it will have done.
  struct Outlook {
    int task = -1, errand = 0;
    bool opened = false;
  };

  void note_states() {
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      const int place = problem_.grid.place(pose_[i].cell), width = problem_.grid.width();
      segments_.insert(segments_.end(), {place / width, place % width, pose_[i].heading, bodies_.progress[i]});
    }
  }

  void tick() {
    const std::size_t robots = pose_.size();
    const auto go = executor_.go(bodies_, delayed_);
    auto acts = go;
    delayed_ = delays_.tick(time_);
    for (std::size_t i = 0; i < robots; ++i) {
      const auto& staged = executor_.staged(static_cast<int>(i));
      if (bodies_.progress[i] == 0) bodies_.begun[i] = staged.empty() ? Action::wait : staged.front();
      acts[i] = acts[i] && !delayed_[i];
    }
    const auto before = bodies_.begun;
    const auto& moved = squares_.advance(bodies_, acts);
    for (std::size_t i = 0; i < robots; ++i) {
      record(go[i] ? before[i] : Action::wait, moved[i] ? before[i] : Action::wait);
      refused_ += acts[i] && !moved[i];
      if (moved[i] && bodies_.progress[i] == 0) executor_.finish(static_cast<int>(i), pose_[i]);
    }
    pose_ = bodies_.pose;
    tasks_.check(time_ + 1, pose_);
  }

  /// Take the answer of the last call.
  void take() {
    for (const auto& step : plan_) executor_.stage(step);
    plan_.clear();
    for (std::size_t i = 0; i < proposal_.size(); ++i) {
      const int held = tasks_.of(static_cast<int>(i));
      if (held >= 0 && tasks_.open(held)) proposal_[i] = held;  // it has not finished yet
    }
    tasks_.assign(time_, proposal_);
  }

  /// Call scheduler and planner for the states after all that is staged.
  void call(int time) {
    const auto began = Clock::now();
    if (guidance_) guidance_->update();
    look_ahead();
    schedule();
    const int steps = wanted_steps();
    const double limit = std::min(options_.limit_s, kTick * options_.period);
    for (int step = 0; step < steps; ++step) {
      aim();
      const double spent = std::chrono::duration<double>(Clock::now() - began).count();
      const double share = std::max(0.0, (0.9 * limit - spent) / (steps - step));
      planner_->plan(view_, {share, options_.iterations}, action_);
      if (guidance_) guidance_->observe(view_.pose, action_);
      for (std::size_t i = 0; i < pose_.size(); ++i) {
        view_.pose[i] = problem_.grid.after(view_.pose[i], action_[i]);
        reach(i);
      }
      plan_.push_back(action_);
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
    call_seconds_.push_back(seconds);
    const double period = kTick * options_.period;
    const int calls =
        options_.iterations ? 1 : std::max(1, static_cast<int>(std::min(std::ceil(seconds / period), 1e6)));
    late_calls_ += calls > 1;
    ready_at_ = time + calls * options_.period;
  }

  void look_ahead() {
    const std::size_t robots = pose_.size();
    outlook_.assign(robots, {});
    view_.pose = executor_.last();
    for (std::size_t i = 0; i < robots; ++i) {
      Outlook& it = outlook_[i];
      it.task = tasks_.of(static_cast<int>(i));
      if (it.task < 0) continue;
      it.errand = tasks_.all()[it.task].progress;
      it.opened = tasks_.open(it.task);
      Pose pose = pose_[i];
      const auto pass = [&] {
        if (it.errand == tasks_.errands(it.task) || tasks_.cell(it.task, it.errand) != pose.cell) return;
        ++it.errand;
        it.opened = true;
      };
      pass();
      for (const Action action : executor_.staged(static_cast<int>(i))) {
        pose = problem_.grid.after(pose, action);
        pass();
      }
    }
  }

  /// Choose tasks for robots that have begun none, and the next tasks of those that soon finish theirs.
  void schedule() {
    const std::size_t robots = pose_.size();
    std::vector<std::int32_t> chosen_for, given;
    std::vector<Pose> from = view_.pose;
    std::vector<std::uint32_t> later(robots, 0);
    std::vector<std::uint8_t> bound(tasks_.all().size(), 0);
    proposal_.assign(robots, -1);
    next_.assign(robots, -1);
    const auto begun = static_cast<std::size_t>(std::ranges::count_if(outlook_, &Outlook::opened));
    const bool all = Scheduler::reassigns(robots - begun, tasks_.unopened().size());
    std::size_t holding = begun;
    const std::uint32_t soon = 3 * static_cast<std::uint32_t>(options_.period / problem_.counter + 2);
    for (std::size_t i = 0; i < robots; ++i) {
      const Outlook& it = outlook_[i];
      const auto robot = static_cast<std::int32_t>(i);
      if (it.task < 0 || (!it.opened && all)) {
        chosen_for.push_back(robot);
        continue;
      }
      proposal_[i] = it.task;
      bound[it.task] = 1;
      holding += !it.opened;
      if (!it.opened) continue;
      if (it.errand == tasks_.errands(it.task)) {
        chosen_for.push_back(robot);
      } else if (it.errand + 1 == tasks_.errands(it.task)) {
        const int last = tasks_.cell(it.task, it.errand);
        later[i] = tables_.to(last).from(view_.pose[i]);
        if (later[i] > soon * tables_.turn()) continue;
        from[i] = {last, view_.pose[i].heading};
        chosen_for.push_back(robot);
      }
    }
    for (const int task : tasks_.unopened()) {
      if (!bound[task]) given.push_back(task);
    }
    const auto found = scheduler_->choose(tasks_, from, chosen_for, given, may_get(holding), later);
    for (std::size_t k = 0; k < found.size(); ++k) {
      const int robot = chosen_for[k];
      const Outlook& it = outlook_[robot];
      const bool finishing = it.task >= 0 && it.opened;
      next_[robot] = found[k];
      if (!finishing || it.errand == tasks_.errands(it.task)) proposal_[robot] = found[k];
    }
    // From here on an outlook tells what a robot has to do after what is staged.
    for (std::size_t i = 0; i < robots; ++i) {
      Outlook& it = outlook_[i];
      if (proposal_[i] == it.task && it.task >= 0) continue;
      it = {proposal_[i], 0, false};
      next_[i] = -1;
    }
  }

  /// How many steps to plan, so that robots have some left when the plan after this one comes.
  int wanted_steps() const {
    const double per_period = static_cast<double>(options_.period) / problem_.counter;
    double staged = 0, moving = 0;
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      const std::size_t own = executor_.staged(static_cast<int>(i)).size();
      staged += static_cast<double>(own);
      moving += own > 0;
    }
    const double left = moving == 0 ? 0 : std::max(0.0, staged / moving - per_period);
    return std::max(1, static_cast<int>(std::ceil(per_period + kSlack - left)));
  }

  /// Set the goals of `view_`.
  void aim() {
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      const Outlook& it = outlook_[i];
      view_.goal[i] = view_.next_goal[i] = -1;
      view_.rest[i] = 0;
      const int count = it.task < 0 ? 0 : tasks_.errands(it.task);
      if (it.errand < count) {
        view_.goal[i] = tasks_.cell(it.task, it.errand);
        view_.rest[i] = scheduler_->rest(tasks_, it.task, it.errand);
        if (it.errand + 1 < count) {
          view_.next_goal[i] = tasks_.cell(it.task, it.errand + 1);
        } else if (next_[i] >= 0) {
          view_.next_goal[i] = tasks_.cell(next_[i], 0);
        }
      } else if (next_[i] >= 0) {
        view_.goal[i] = tasks_.cell(next_[i], 0);
        view_.rest[i] = scheduler_->rest(tasks_, next_[i], 0);
      }
    }
  }

  /// A robot has entered a cell in the plan.
  void reach(std::size_t i) {
    Outlook& it = outlook_[i];
    if (it.task < 0 || it.errand == tasks_.errands(it.task)) return;
    it.errand += tasks_.cell(it.task, it.errand) == view_.pose[i].cell;
  }

  Executor executor_;
  Squares squares_;
  DelayModel delays_;
  View view_;
  Bodies bodies_;
  std::vector<std::uint8_t> delayed_;
  std::vector<Outlook> outlook_;
  std::vector<std::int32_t> proposal_, next_, segments_;
  std::vector<std::vector<Action>> plan_;
  std::vector<Action> action_;
  int ready_at_ = 0, first_ = 0, refused_ = 0;
};

}  // namespace

std::unique_ptr<Ticks> make_ticks(Problem problem, LeagueOptions options) {
  return std::make_unique<TickLeague>(std::move(problem), std::move(options));
}

}  // namespace mrpbench::discrete
