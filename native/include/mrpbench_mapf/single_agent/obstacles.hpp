// What a search for one robot has to avoid, asked once for every vertex and edge that the search touches.
#pragma once

#include <vector>

#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

class Obstacles {
 public:
  virtual ~Obstacles() = default;
  /// Append the half-ticks during which the robot must not be at `vertex`, in any order.
  virtual void at_vertex(int vertex, std::vector<Range>& halves) const = 0;
  /// Append the ticks at which it must not enter `edge`, which takes it `duration` ticks.
  virtual void on_edge(int edge, Tick duration, std::vector<Range>& departures) const = 0;
};

/// Sort, and unite ranges that meet or touch.
void unite(std::vector<Range>& ranges);

}  // namespace mrpbench::mapf
