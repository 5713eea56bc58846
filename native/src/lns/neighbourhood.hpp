// Chooses the robots that are planned anew together. In a plan without conflicts: robots in the way of a late robot,
// robots that meet at a crossing, or random robots (Li et al., IJCAI 2021). In a plan with conflicts: robots that
// conflict with one another, robots in the way to a goal, or random robots (Li et al., AAAI 2022).
#pragma once

#include "lns/schedule.hpp"
#include "mrpbench_mapf/common/random.hpp"

namespace mrpbench::mapf::lns {

class Neighbourhood {
 public:
  Neighbourhood(const Schedule& schedule, DistanceTables& tables, std::uint64_t seed);

  // All choose at most `size` robots.

  /// Robot `late`, and robots that keep it from getting to its goal earlier.
  const std::vector<int>& around_late(int late, int size);
  /// Robots that pass the crossings around a place.
  const std::vector<int>& at_crossing(int size);
  const std::vector<int>& any(int size);
  /// Robots that conflict with `robot`, directly or through others; `partners` is by robot.
  const std::vector<int>& in_conflict(int robot, const std::vector<std::vector<int>>& partners, int size);
  /// `robot`, those that pass its goal, and those whose goals it passes.
  const std::vector<int>& at_goal(int robot, int size);

 private:
  void clear(int size);
  bool full() const { return static_cast<int>(chosen_.size()) >= size_; }
  void add(int robot);
  void walk(int robot);
  void meet(int robot, int vertex, Tick from, Tick to);
  void fill();

  const Schedule& schedule_;
  const Roadmap& roadmap_;
  DistanceTables& tables_;
  int size_ = 0;
  Random random_;
  std::vector<int> chosen_;
  std::vector<bool> is_chosen_;
  std::vector<std::int32_t> queue_;
  std::vector<std::uint32_t> seen_;  // by vertex: the search that came by last
  std::uint32_t search_ = 0;
};

}  // namespace mrpbench::mapf::lns
