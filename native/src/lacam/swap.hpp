// When two robots that meet in a narrow passage change places: the swap operation of Okumura, "Improving LaCAM for
// scalable eventually optimal multi-agent pathfinding", IJCAI 2023.
#pragma once

#include <span>

#include "lacam/moves.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf::lacam {

class Swap {
 public:
  Swap(const Instance& instance, const Moves& moves, DistanceTables& tables);

  /// The robot with which `robot`, which wants to go from `here` to `wanted`, should change places, or -1; it then
  /// backs away first and pulls the other along. `now` is the robot by vertex (-1 = none), `to` where robots go (-1 =
  /// not known yet).
  int partner(int robot, int here, int wanted, std::span<const std::int32_t> now, const std::int32_t* to);

 private:
  static constexpr std::int32_t kNone = -1, kSeveral = -2;

  std::int32_t only_way(int robot, int before, int here) const;
  bool must_swap(int pusher, int puller, int pusher_at, int puller_at);
  bool can_swap(int robot, int pusher_at, int puller_at) const;

  const Moves& moves_;
  std::vector<DistanceTable*> distance_;
  std::vector<std::int32_t> goal_;
  std::span<const std::int32_t> now_;
};

}  // namespace mrpbench::mapf::lacam
