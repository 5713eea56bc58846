// Who is where at which tick, on roadmaps of unit moves: counts the conflicts of a move without looking at robots that
// are elsewhere. The conflict avoidance table of Standley, "Finding optimal solutions to cooperative pathfinding
// problems", AAAI 2010.
#pragma once

#include <cstdlib>
#include <memory>
#include <vector>

#include "mrpbench_mapf/bounded/unit_roadmap.hpp"
#include "mrpbench_mapf/limits.hpp"

namespace mrpbench::mapf {

class PathTable {
 public:
  PathTable(int vertex_count, int robots, Limits& limits);

  /// `steps` must stay where they are until they are removed. Each vertex is the last one of one path at most.
  void add(int robot, Steps steps);
  void remove(int robot);
  Steps path(int robot) const { return paths_[robot]; }

  /// Where a robot is at a tick, also after its arrival.
  std::int32_t position(int robot, Tick tick) const {
    const Steps steps = paths_[robot];
    return tick < static_cast<Tick>(steps.size()) ? steps[tick] : steps.back();
  }
  /// Call `found(robot)` for all who are at `vertex` at `tick`.
  template <class Found>
  void visitors(int vertex, Tick tick, Found found) const {
    if (tick >= parked_from_[vertex]) found(static_cast<int>(parked_[vertex]));
    if (tick >= ticks_) return;
    for (int robot = row_[tick][vertex]; robot != 0; robot = next_[robot - 1][tick]) found(robot - 1);
  }
  /// Call `found(robot)` for all who go from `to` to `from` between `tick` and `tick + 1`.
  template <class Found>
  void swappers(int from, int to, Tick tick, Found found) const {
    if (tick + 1 >= ticks_ || row_[tick + 1][from] == 0) return;
    for (int robot = row_[tick][to]; robot != 0; robot = next_[robot - 1][tick]) {
      if (tick + 1 < static_cast<Tick>(paths_[robot - 1].size()) && paths_[robot - 1][tick + 1] == from) {
        found(robot - 1);
      }
    }
  }
  /// Conflicts of a robot that is not in the table and goes (or waits) from `from` at `tick` to `to`.
  int count(int from, int to, Tick tick) const {
    int number = tick + 1 >= parked_from_[to];
    if (tick + 1 >= ticks_) return number;
    for (int robot = row_[tick + 1][to]; robot != 0; robot = next_[robot - 1][tick + 1]) ++number;
    if (from != to && row_[tick][to] != 0) swappers(from, to, tick, [&](int) { ++number; });
    return number;
  }
  /// The tick from which on nobody has ever moved.
  Tick ticks() const { return ticks_; }

 private:
  struct Free {
    void operator()(std::uint16_t* block) const { std::free(block); }
  };
  void grow();

  int vertex_count_;
  Limits& limits_;
  Tick ticks_ = 0;
  std::vector<std::unique_ptr<std::uint16_t[], Free>> blocks_;  // of many rows: zeros that cost nothing until touched
  std::vector<std::uint16_t*> row_;                             // by tick, then by vertex: first robot + 1, 0 = none
  std::vector<std::vector<std::uint16_t>> next_;                // by robot and tick: next robot + 1 in the same cell
  std::vector<Steps> paths_;
  std::vector<Tick> parked_from_;  // by vertex: from when on someone stands there for good
  std::vector<std::int32_t> parked_;
};

}  // namespace mrpbench::mapf
