// Makes a plan without conflicts out of one with conflicts, a group of robots at a time (Li et al., AAAI 2022).
#pragma once

#include "lns/neighbourhood.hpp"
#include "lns/roulette.hpp"

namespace mrpbench::mapf::lns {

class Repair {
 public:
  Repair(Schedule& schedule, int neighbourhood, std::uint64_t seed);

  /// A first path for every robot, with few conflicts; false if some robot has no path at all.
  bool begin();
  /// Plan one group anew; keeps what has no more conflicts.
  void advance();
  bool is_done() const { return pairs_ == 0; }
  int pairs() const { return pairs_; }

 private:
  int conflicts_of(int robot, const Path& path, std::vector<int>& partners);
  void link(int robot, const std::vector<int>& partners);
  void unlink(int robot);
  const std::vector<int>& choose(int heuristic);

  Schedule& schedule_;
  Neighbourhood neighbourhood_;
  int size_;
  Random random_;
  Roulette<3> roulette_;
  int pairs_ = 0;
  std::vector<std::vector<int>> partners_;  // by robot: those it is in conflict with
  std::vector<std::vector<int>> fresh_;
  std::vector<int> robots_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t count_ = 0;
};

}  // namespace mrpbench::mapf::lns
