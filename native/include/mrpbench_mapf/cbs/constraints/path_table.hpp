// Which robot is where at which tick in classical instances: the conflicts of a step are found without checking
// other robots.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include "mrpbench_mapf/cbs/constraints/timed_path.hpp"
#include "mrpbench_mapf/common/limits.hpp"

namespace mrpbench::mapf {

class PathTable {
 public:
  PathTable(int vertex_count, int robots, Limits& limits);

  /// The path must stay where it is until it is removed.
  void add(int robot, const TimedPath& path);
  void remove(int robot);

  /// Call `found(robot)` for all robots at `vertex` at `tick` that do not yet stay there for good.
  template <class Found>
  void visitors(int vertex, Tick tick, Found found) const {
    if (tick >= ticks_) return;
    for (int robot = row_[tick][vertex]; robot != 0; robot = next_[robot - 1][tick]) found(robot - 1);
  }
  /// ... for all robots that stay there for good and arrived before `tick`.
  template <class Found>
  void parked(int vertex, Tick tick, Found found) const {
    for (int robot = parked_[vertex]; robot != 0; robot = next_parked_[robot - 1]) {
      if (tick > paths_[robot - 1].last_tick()) found(robot - 1);
    }
  }
  /// ... for all robots that go from `to` to `from` between `tick` and `tick + 1`.
  template <class Found>
  void swappers(int from, int to, Tick tick, Found found) const {
    if (tick + 1 >= ticks_ || row_[tick + 1][from] == 0) return;
    for (int robot = row_[tick][to]; robot != 0; robot = next_[robot - 1][tick]) {
      const TimedPath& path = paths_[robot - 1];
      if (tick < path.last_tick() && path.at[tick + 1] == from) found(robot - 1);
    }
  }
  /// Conflicts of a robot that is not in the table and goes (or waits) from `from` at `tick` to `to`.
  int count(int from, int to, Tick tick) const {
    int number = 0;
    if (parked_[to] != 0) parked(to, tick + 1, [&](int) { ++number; });
    if (tick + 1 >= ticks_) return number;
    visitors(to, tick + 1, [&](int) { ++number; });
    if (from != to) swappers(from, to, tick, [&](int) { ++number; });
    return number;
  }
  /// Conflicts of a robot that is not in the table and stays at `vertex` for good after `tick`.
  int count_staying(int vertex, Tick tick) const {
    if (visits_[vertex] == 0) return 0;
    int number = 0;
    while (++tick < ticks_) visitors(vertex, tick, [&](int) { ++number; });
    return number;
  }
  const TimedPath& path(int robot) const { return paths_[robot]; }
  /// Tell whether any path visits `vertex`.
  bool is_visited(int vertex) const { return visits_[vertex] != 0; }
  /// The tick from which on no robot in the table has ever moved.
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
  std::vector<TimedPath> paths_;
  std::vector<std::int32_t> visits_;        // by vertex
  std::vector<std::uint16_t> parked_;       // by vertex: first robot + 1 that stays there for good, 0 = none
  std::vector<std::uint16_t> next_parked_;  // by robot: next robot + 1 at the same vertex
};

}  // namespace mrpbench::mapf
