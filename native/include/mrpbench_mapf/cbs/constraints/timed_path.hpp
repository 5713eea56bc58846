// The path of one robot as conflict-based search keeps it.
#pragma once

#include "mrpbench_mapf/cbs/constraints/space.hpp"
#include "mrpbench_mapf/common/arena.hpp"
#include "mrpbench_mapf/model/result.hpp"

namespace mrpbench::mapf {

/// One of the two spans is used: `at` in classical instances (`Space::classical`), else `occupied`.
struct TimedPath {
  static constexpr std::int32_t kAnyGoal = -1;  // that the robot may take

  std::span<const std::int32_t> at;      // at[t] = vertex at tick t; stays at the last one, or disappears
  std::span<const Occupation> occupied;  // as in `Result`
  Tick cost = 0;                         // tick at which the last move ends
  bool stays = true;                     // at the end, for good
  std::int32_t goal = kAnyGoal;          // the one that it was made for

  bool empty() const { return at.empty() && occupied.empty(); }
  /// Tell whether they share their data.
  bool operator==(const TimedPath& other) const {
    return at.data() == other.at.data() && occupied.data() == other.occupied.data();
  }
  /// Where the last move ends.
  int end() const { return at.empty() ? occupied.back().element : at.back(); }
  Tick last_tick() const { return static_cast<Tick>(at.size()) - 1; }
  /// Classical instances: the vertex at `tick`, -1 if the robot has disappeared.
  int vertex(Tick tick) const { return tick <= last_tick() ? at[tick] : stays ? at.back() : -1; }
};

/// A path being made, before it is kept.
struct FoundPath {
  std::vector<std::int32_t> at;
  Path occupied;
  Tick cost = 0;
  std::int32_t goal = TimedPath::kAnyGoal;
};

/// Where a robot is on a path.
struct Stop {
  std::int32_t vertex;
  Tick tick;
  std::int32_t edge;  // by which it came, -1 = by waiting
};

/// Make `path` from the stops of `robot`, of which the first is where it is free to move.
void follow(const Space& space, int robot, std::span<const Stop> stops, FoundPath& path);

/// Keeps paths.
class PathStore {
 public:
  PathStore(bool stays, Limits& limits) : stays_(stays), at_(limits), occupied_(limits) {}
  TimedPath keep(const FoundPath& path) {
    return {at_.copy(path.at), occupied_.copy(path.occupied), path.cost, stays_, path.goal};
  }
  void clear() {
    at_.clear();
    occupied_.clear();
  }

 private:
  bool stays_;
  Arena<std::int32_t> at_;
  Arena<Occupation> occupied_;
};

/// The path of `robot` as results contain it.
Path occupations(const Space& space, int robot, const TimedPath& path);

}  // namespace mrpbench::mapf
