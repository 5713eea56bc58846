#include "lns/improvement.hpp"

#include <algorithm>

namespace mrpbench::mapf::lns {

Improvement::Improvement(Schedule& schedule, Objective objective, std::optional<int> neighbourhood, std::uint64_t seed)
    : schedule_(schedule),
      objective_(objective),
      neighbourhood_(schedule, schedule.tables(), seed + 1),
      random_(seed),
      size_(neighbourhood),
      tried_(schedule.instance().size()) {}

bool Improvement::is_done() const {
  for (int robot = 0; robot < schedule_.instance().size(); ++robot) {
    if (schedule_.delay(robot) > 0) return false;
  }
  return true;
}

void Improvement::copy_changed(std::vector<Path>& paths) {
  for (const int robot : changed_) paths[robot] = schedule_.paths()[robot];
  changed_.clear();
}

bool Improvement::advance() {
  schedule_.limits().check_clock();
  const int heuristic = heuristics_.spin(random_), size = sizes_.spin(random_);
  robots_ = choose(heuristic, size_.value_or(kSizes[size]));
  random_.shuffle(robots_);
  const std::int64_t before = schedule_.expansions();
  const Value gain = plan();
  const double effort = 1e-3 * static_cast<double>(schedule_.expansions() - before + kOverhead * robots_.size());
  heuristics_.reward(heuristic, static_cast<double>(gain.first) / effort);
  sizes_.reward(size, static_cast<double>(gain.first) / effort);
  return gain > Value{0, 0};
}

/// Plan the group anew and keep what is not worse; what it gained.
Value Improvement::plan() {
  Cost sum = 0, least = 0;
  Tick last = 0;
  for (const int robot : robots_) {
    sum += arrival(schedule_.paths()[robot]);
    least += schedule_.least(robot);
    last = std::max(last, arrival(schedule_.paths()[robot]));
  }
  if (sum == least) return {0, 0};
  // A robot that arrives later than this makes the group worse, even if the rest of it is not delayed at all.
  Cost left = sum - least;
  const auto latest = [&](int k) {
    if (k > 0) left -= arrival(schedule_.fresh()[k - 1]) - schedule_.least(robots_[k - 1]);
    return objective_ == Objective::makespan ? last : static_cast<Tick>(schedule_.least(robots_[k]) + left);
  };
  const Value before = objective_ == Objective::makespan ? Value{last, sum} : Value{sum, sum};
  const bool found = schedule_.plan(robots_, Others::hard, latest);
  const std::span<const Path> fresh(schedule_.fresh().data(), robots_.size());
  if (!found || value(objective_, fresh) > before) {
    schedule_.reject(robots_);
    return {0, 0};
  }
  const Value after = value(objective_, fresh);
  schedule_.accept(robots_);
  changed_.insert(changed_.end(), robots_.begin(), robots_.end());
  return {before.first - after.first, before.second - after.second};
}

const std::vector<int>& Improvement::choose(int heuristic, int size) {
  if (heuristic == 0) return neighbourhood_.around_late(late_robot(), size);
  return heuristic == 1 ? neighbourhood_.at_crossing(size) : neighbourhood_.any(size);
}

/// The latest robot (by its delay; for the makespan, by its arrival) of those that were not tried yet.
int Improvement::late_robot() {
  const auto lateness = [&](int robot) {
    return objective_ == Objective::makespan ? arrival(schedule_.paths()[robot]) : schedule_.delay(robot);
  };
  int latest = -1;
  for (int robot = 0; robot < schedule_.instance().size(); ++robot) {
    if (!tried_[robot] && schedule_.delay(robot) > 0 && (latest < 0 || lateness(robot) > lateness(latest))) {
      latest = robot;
    }
  }
  if (latest >= 0) {
    tried_[latest] = true;
    return latest;
  }
  tried_.assign(tried_.size(), false);
  return random_.below(schedule_.instance().size());
}

}  // namespace mrpbench::mapf::lns
