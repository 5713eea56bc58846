// True distances to one goal on a roadmap of unit moves, by one breadth-first search backwards that runs only as far as
// it is asked. Silver, "Cooperative Pathfinding", AIIDE 2005.
#pragma once

#include <vector>

#include "mrpbench_mapf/bounded/unit_roadmap.hpp"
#include "mrpbench_mapf/limits.hpp"

namespace mrpbench::mapf {

class UnitDistance {
 public:
  /// No way leads through `closed`, -1 = none; distances from there itself make no sense.
  UnitDistance(const UnitRoadmap& roadmap, int goal, Limits& limits, int closed = -1);

  /// Memory of one table.
  static std::size_t bytes(const UnitRoadmap& roadmap) {
    return static_cast<std::size_t>(roadmap.vertex_count()) * (sizeof(Tick) + sizeof(std::int32_t));
  }

  /// Ticks from `vertex` to the goal, kForever if there is no way.
  Tick operator()(int vertex) {
    if (distance_[vertex] == kForever && next_ < queue_.size()) search(vertex);
    return distance_[vertex];
  }

 private:
  void search(int vertex);

  const UnitRoadmap& roadmap_;
  Limits& limits_;
  std::vector<Tick> distance_;
  std::vector<std::int32_t> queue_;  // first in, first out from `next_`
  std::size_t next_ = 0;
};

}  // namespace mrpbench::mapf
