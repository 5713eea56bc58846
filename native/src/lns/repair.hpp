// Makes a plan without conflicts out of one with conflicts, a group of robots at a time (Li et al., AAAI 2022). Where
// there is room, the first paths have few conflicts or none: the robots are planned in turn, each around the robots
// planned before it. Robots with short paths are first, because the others can go around their goals.
#pragma once

#include <limits>

#include "lns/neighbourhood.hpp"
#include "lns/roulette.hpp"

namespace mrpbench::mapf::lns {

/// When to give up.
struct Patience {
  /// Where more robots find no way between those before them, there is too little room for planning in turn.
  int in_the_way = std::numeric_limits<int>::max();
  std::int64_t iterations = std::numeric_limits<std::int64_t>::max();
  /// Times the expansions of the first paths.
  double effort = std::numeric_limits<double>::infinity();

  /// For trying whether there is a cheaper plan than a known one.
  static Patience brief(int robots) { return {.in_the_way = robots / 8, .effort = 2}; }
};

class Repair {
 public:
  static constexpr int kNeighbourhood = 8;  // robots at a time, by default

  Repair(Schedule& schedule, int neighbourhood, std::uint64_t seed);

  /// Begin, then plan groups anew until no conflict is left; false if patience ran out before.
  bool run(const Patience& patience, std::int64_t& iterations);

  // The same step by step.

  /// A first path for every robot; false if one has none, or if more than so many are in the way of others.
  bool begin(int most_in_the_way = std::numeric_limits<int>::max());
  /// No conflict is left.
  bool is_done() const { return pairs_ == 0; }
  /// Plan a group anew.
  void advance();

 private:
  bool plan_first(int robot, Tick latest, int& in_the_way, int most_in_the_way);
  int conflicts_of(int robot, const Path& path, std::vector<int>& partners);
  void count_conflicts(const std::vector<int>& robots);
  void replan_and_count();
  void link(int robot, const std::vector<int>& partners);
  void unlink(int robot);
  const std::vector<int>& choose(int heuristic);

  Schedule& schedule_;
  Neighbourhood neighbourhood_;
  int size_;
  Random random_;
  Roulette<3> roulette_;
  bool has_roomy_resources_;
  int pairs_ = 0;
  std::vector<std::vector<int>> partners_;  // by robot: those it is in conflict with
  std::vector<int> robots_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t count_ = 0;
};

}  // namespace mrpbench::mapf::lns
