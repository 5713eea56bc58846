// How many robots would be in the way of a step: the conflict avoidance table of Standley, "Finding optimal solutions
// to cooperative pathfinding problems", AAAI 2010. It breaks ties, guides focal searches, and finds conflicts.
#pragma once

#include "mrpbench_mapf/cbs/constraints/path_table.hpp"
#include "mrpbench_mapf/cbs/constraints/space.hpp"

namespace mrpbench::mapf {

class AvoidanceTable {
 public:
  AvoidanceTable(const Space& space, Limits& limits);

  /// The path must stay where it is until it is removed. A robot with an empty path is in no robot's way.
  void add(int robot, const TimedPath& path);
  void remove(int robot);
  /// Call after changes, before questions.
  void refresh();

  /// Robots in the way of `robot`, whose own path must not be in the table, if it stands at `vertex` from tick `at` to
  /// the next, that one included.
  int waiting(int robot, int vertex, Tick at) const {
    if (ticks_) return ticks_->count(vertex, vertex, at);
    return reservations_->count(robot, {vertex, 2 * at + 1, 2 * at + 2});
  }
  /// ... if it makes `move` out of `vertex` at tick `at`, the arrival included.
  int moving(int robot, int vertex, const Move& move, Tick at) const {
    return ticks_ ? ticks_->count(vertex, move.head, at) : moving_on_lanes(robot, move, at);
  }
  /// ... if it stays at `vertex` for good after tick `at`.
  int staying(int robot, int vertex, Tick at) const {
    if (ticks_) return ticks_->count_staying(vertex, at);
    return reservations_->count(robot, {vertex, 2 * at + 1, kForeverHalf});
  }

  /// Classical instances: all robots, tick by tick.
  const PathTable& ticks() const { return *ticks_; }
  /// Otherwise: all robots, by intervals, and the paths these come from.
  const Reservations& reservations() const { return *reservations_; }
  const TimedPath& path(int robot) const { return paths_[robot]; }

 private:
  int moving_on_lanes(int robot, const Move& move, Tick at) const;

  int vertices_;
  std::optional<PathTable> ticks_;
  std::optional<Reservations> reservations_;
  std::vector<TimedPath> paths_;  // by robot; only with reservations
  bool stale_ = false;            // `reservations_` differs from `paths_`
};

}  // namespace mrpbench::mapf
