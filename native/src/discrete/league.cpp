// What steps and ticks share: the parts of an execution, and the preprocessing.
#include "mrpbench_discrete/league.hpp"

#include <numeric>
#include <unordered_set>

#include "guidance.hpp"
#include "scheduler.hpp"

namespace mrpbench::discrete {
namespace {

constexpr std::size_t kWhole = std::size_t{1} << 27;
///< Cells of whole tables of all goals of a time, up to which tables are whole: about 20 s of computing.

bool clustered(const Problem& problem) {
  const std::unordered_set<std::int32_t> cells(problem.errands.begin(), problem.errands.end());
  const std::size_t visible = problem.visible;
  const std::size_t goals = problem.season == 2023 ? problem.robots() * visible : problem.robots() + visible;
  return std::min(cells.size(), goals) * problem.grid.size() > kWhole;
}

}  // namespace

League::League(Problem problem, LeagueOptions options)
    : problem_(std::move(problem)),
      options_(std::move(options)),
      tables_(problem_.grid, options_.table_bytes, clustered(problem_)),
      tasks_(problem_),
      scheduler_(std::make_unique<Scheduler>(problem_, tables_)),
      planner_(make_planner(options_.planner, options_.seed)) {
  for (const int cell : problem_.start) pose_.push_back({cell, 0});
  if (options_.guidance && !tables_.clustered()) guidance_ = std::make_unique<Guidance>(problem_.grid, tables_);
  active_ =
      options_.active ? *options_.active : std::max(1, problem_.grid.size() * (problem_.season == 2023 ? 3 : 4) / 8);
}

League::~League() = default;

void League::preprocess() {
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - opened_).count();
  };
  if (!options_.iterations) {
    for (const int goal : first_goals()) {
      if (seconds() >= options_.preprocessing_s || tables_.full()) break;
      tables_.to(goal);
    }
  }
  preprocessing_seconds_ = seconds();
}

/// Cells to which the first answers ask for the way. The scheduler needs no clustered tables, so that of those only the
/// ones of tasks that robots get are needed.
std::vector<std::int32_t> League::first_goals() {
  std::vector<std::int32_t> found, robots(pose_.size()), tasks = tasks_.unopened();
  if (problem_.season == 2023) {
    for (std::size_t i = 0; i < pose_.size(); ++i) {
      for (const int task : tasks_.queue(static_cast<int>(i))) found.push_back(tasks_.cell(task, 0));
    }
    return found;
  }
  if (tables_.clustered()) {
    std::iota(robots.begin(), robots.end(), 0);
    tasks = scheduler_->choose(tasks_, pose_, robots, tasks, may_get(0));
    std::erase(tasks, -1);
  }
  for (const int task : tasks) found.push_back(tasks_.cell(task, 0));
  for (const int task : tasks) {
    for (int k = 1; !tables_.clustered() && k < tasks_.errands(task); ++k) found.push_back(tasks_.cell(task, k));
  }
  return found;
}

void League::record(Action asked, Action done) {
  if (asked != done) {
    const auto row = static_cast<std::int32_t>(letters_.size() / pose_.size());
    const auto robot = static_cast<std::int32_t>(letters_.size() % pose_.size());
    unexecuted_.push_back({row, robot, static_cast<std::int32_t>(asked)});
  }
  letters_.push_back(static_cast<std::uint8_t>(done));
}

}  // namespace mrpbench::discrete
