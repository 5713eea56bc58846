#include "lns/improvement.hpp"

#include <algorithm>

namespace mrpbench::mapf::lns {

Improvement::Improvement(Schedule& schedule, Objective objective, int neighbourhood, std::uint64_t seed)
    : schedule_(schedule),
      objective_(objective),
      neighbourhood_(schedule, schedule.tables(), neighbourhood, seed + 1),
      random_(seed),
      tried_(schedule.instance().size()) {}

bool Improvement::is_done() const {
  for (int robot = 0; robot < schedule_.instance().size(); ++robot) {
    if (schedule_.delay(robot) > 0) return false;
  }
  return true;
}

bool Improvement::advance() {
  schedule_.limits().check_clock();
  const int heuristic = roulette_.spin(random_);
  robots_ = choose(heuristic);
  random_.shuffle(robots_);
  Cost sum = 0, least = 0;
  Tick last = 0;
  for (const int robot : robots_) {
    sum += arrival(schedule_.paths()[robot]);
    least += schedule_.least(robot);
    last = std::max(last, arrival(schedule_.paths()[robot]));
  }
  if (sum == least) {
    roulette_.reward(heuristic, 0);
    return false;
  }
  // Whoever arrives later than this makes the group worse, even if the rest of it is not delayed at all.
  Cost left = sum - least;
  const auto latest = [&](int k) {
    if (k > 0) left -= arrival(schedule_.fresh()[k - 1]) - schedule_.least(robots_[k - 1]);
    return objective_ == Objective::makespan ? last : static_cast<Tick>(schedule_.least(robots_[k]) + left);
  };
  if (!schedule_.plan(robots_, Others::hard, latest)) {
    schedule_.reject(robots_);
    roulette_.reward(heuristic, 0);
    return false;
  }
  const Value before = objective_ == Objective::makespan ? Value{last, sum} : Value{sum, sum};
  const Value after = value(objective_, schedule_.fresh());
  if (after > before) {
    schedule_.reject(robots_);
  } else {
    schedule_.accept(robots_);
  }
  const double gain = std::max<double>(0, static_cast<double>(before.first - after.first));
  roulette_.reward(heuristic, gain / static_cast<double>(robots_.size()));
  return after < before;
}

const std::vector<int>& Improvement::choose(int heuristic) {
  if (heuristic == 0) return neighbourhood_.around_late(late_robot());
  return heuristic == 1 ? neighbourhood_.at_crossing() : neighbourhood_.any();
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
