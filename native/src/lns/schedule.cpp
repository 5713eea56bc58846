#include "lns/schedule.hpp"

namespace mrpbench::mapf::lns {

Schedule::Schedule(const Instance& instance, DistanceTables& tables, const Relations& relations, std::uint64_t seed,
                   Limits& limits, Statistics& statistics)
    : instance_(instance),
      tables_(tables),
      limits_(limits),
      traffic_(instance, relations, limits),
      sipps_(traffic_, seed, limits, statistics),
      paths_(instance.size()) {
  for (int robot = 0; robot < instance.size(); ++robot) {
    least_.push_back(static_cast<Tick>(tables.least_cost(instance, robot)));
    hold(robot);
  }
}

void Schedule::replace(std::vector<Path> paths) {
  for (int robot = 0; robot < instance_.size(); ++robot) {
    if (paths_[robot].empty()) {
      drop_hold(robot);
    } else {
      traffic_.remove(robot, paths_[robot]);
    }
    traffic_.add(robot, paths[robot]);
  }
  paths_ = std::move(paths);
}

void Schedule::accept(const std::vector<int>& robots) {
  for (std::size_t k = 0; k < robots.size(); ++k) std::swap(paths_[robots[k]], fresh_[k]);
}

void Schedule::reject(const std::vector<int>& robots) {
  for (std::size_t k = 0; k < robots.size(); ++k) {
    const int robot = robots[k];
    if (k < planned_) {
      traffic_.remove(robot, fresh_[k]);
    } else {
      drop_hold(robot);
    }
    if (paths_[robot].empty()) {
      hold(robot);
    } else {
      traffic_.add(robot, paths_[robot]);
    }
  }
}

/// Does the robot bind others before it has a path? Standing at its start at tick 0 alone binds none, unless robots may
/// be late.
bool Schedule::holds(int robot) const {
  const Beginning& beginning = instance_.beginning(robot);
  return beginning.occupied.size() > 1 || beginning.free_at > 0 || instance_.rules().k > 0;
}

void Schedule::hold(int robot) {
  if (holds(robot)) traffic_.add(robot, instance_.beginning(robot).occupied);
}

void Schedule::drop_hold(int robot) {
  if (holds(robot)) traffic_.remove(robot, instance_.beginning(robot).occupied);
}

void Schedule::lift(const std::vector<int>& robots) {
  for (const int robot : robots) {
    if (paths_[robot].empty()) continue;
    traffic_.remove(robot, paths_[robot]);
    hold(robot);
  }
}

}  // namespace mrpbench::mapf::lns
