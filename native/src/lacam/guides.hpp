// A way for each robot that it follows where it can. Ways that keep clear of one another spread the robots over the
// roadmap: the space utilisation of Okumura, "Engineering LaCAM*: Towards real-time, large-scale, and near-optimal
// multi-agent pathfinding", AAMAS 2024.
#pragma once

#include "lns/schedule.hpp"

namespace mrpbench::mapf::lacam {

class Guides {
 public:
  /// Plans all robots in `schedule`, which holds paths with conflicts from then on.
  explicit Guides(lns::Schedule& schedule);

  /// Where `robot` should go from `vertex`, -1 if its way does not lead there.
  std::int32_t next(int robot, std::int32_t vertex) const;
  /// When the last robot would arrive.
  Tick longest() const { return longest_; }

 private:
  static constexpr int kRounds = 2;    // in the first one the others' ways are not known yet
  static constexpr Tick kDetour = 10;  // ticks by which a way may be longer than the shortest
  struct Step {
    std::int32_t from, to;
  };
  std::vector<std::vector<Step>> steps_;  // by robot, sorted by `from`
  Tick longest_ = 0;
};

}  // namespace mrpbench::mapf::lacam
