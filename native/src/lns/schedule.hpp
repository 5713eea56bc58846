// The present paths of all robots with what planning some of them anew needs.
#pragma once

#include "lns/sipps.hpp"

namespace mrpbench::mapf::lns {

class Schedule {
 public:
  Schedule(const Instance& instance, DistanceTables& tables, const Relations& relations, std::uint64_t seed,
           Limits& limits, Statistics& statistics);

  const Instance& instance() const { return instance_; }
  const Traffic& traffic() const { return traffic_; }
  DistanceTables& tables() { return tables_; }
  /// Of all searches so far.
  std::int64_t expansions() const { return sipps_.expansions(); }
  Limits& limits() { return limits_; }
  const std::vector<Path>& paths() const { return paths_; }
  /// Ticks that the robot takes longer than if it were alone.
  Tick delay(int robot) const { return arrival(paths_[robot]) - least_[robot]; }
  Tick least(int robot) const { return least_[robot]; }

  /// Replace all paths.
  void replace(std::vector<Path> paths);
  /// Plan `robots` anew in their order; the present paths of the others are hard or soft. `latest(k)` is when the k-th
  /// one has to arrive, given the arrivals of those before it. The new paths are in `fresh()`; false if some robot
  /// found none.
  template <class Latest>
  bool plan(const std::vector<int>& robots, Others others, Latest latest) {
    lift(robots);
    fresh_.resize(robots.size());
    planned_ = 0;
    for (const int robot : robots) {
      drop_hold(robot);
      if (!sipps_.search(robot, tables_[robot], others, latest(static_cast<int>(planned_)), fresh_[planned_])) {
        hold(robot);
        return false;
      }
      traffic_.add(robot, fresh_[planned_++]);
    }
    return true;
  }
  const std::vector<Path>& fresh() const { return fresh_; }
  /// After `plan`: keep the new paths, or go back to the old ones.
  void accept(const std::vector<int>& robots);
  void reject(const std::vector<int>& robots);

 private:
  bool holds(int robot) const;
  void hold(int robot);
  void drop_hold(int robot);
  void lift(const std::vector<int>& robots);

  const Instance& instance_;
  DistanceTables& tables_;
  Limits& limits_;
  Traffic traffic_;
  Sipps sipps_;
  std::vector<Path> paths_, fresh_;
  std::vector<Tick> least_;
  std::size_t planned_ = 0;
};

}  // namespace mrpbench::mapf::lns
