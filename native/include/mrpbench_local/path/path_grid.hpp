// The local plan on the costmap, and how far its cells are from it.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_local/costmap/grid.hpp"

namespace mrpbench::local {

/// The part of a path that a robot uses.
struct Pruning {
  double prune_distance = 1;
  bool shorten = true;
  /// Without it a robot with its front beyond the end would be off the path, and robots would brake long before it.
  double beyond_end = 0.35;
};

class PathGrid {
 public:
  /// Take the beginning of a path, up to where it leaves the frame or is farther from the robot than the pruning says.
  /// Returns how many points of the rest that needed.
  std::size_t take(const Frame& frame, Point robot, Point first, std::span<const Point> rest, const Pruning& pruning);

  bool empty() const { return cells_.empty(); }
  /// The point to drive to: the last one of the local plan, or beyond the end of the path while the robot is not there.
  Point goal() const { return goal_; }
  /// Metres to the end of the path, infinite where the local plan does not hold it.
  double left() const { return left_; }
  /// The cells of the plan without its last pose.
  Cell before_end() const { return cells_[cells_.size() > 1 ? cells_.size() - 2 : 0]; }
  const std::vector<Cell>& cells() const { return cells_; }
  /// A point of the plan in each of its cells.
  const std::vector<Point>& points() const { return points_; }

  /// Steps along rows and columns to the nearest cell of the plan, or straight beyond its end.
  int distance(const Frame& frame, Cell c) const { return knows(c) ? distance_[frame.index(c)] : distance_from(c); }
  /// Tell whether the distance of a cell is computed.
  bool knows(Cell c) const { return c.x >= low_.x && c.y >= low_.y && c.x <= high_.x && c.y <= high_.y; }
  /// Distances by the index of the cell in the frame, where they are computed.
  const std::vector<std::int16_t>& distances() const { return distance_; }
  /// Compute the distances of the cells from `low` to `high`; obstacles do not matter.
  void spread(const Frame& frame, Cell low, Cell high);
  void spread(const Frame& frame) { spread(frame, {0, 0}, {frame.width - 1, frame.height - 1}); }

 private:
  int distance_from(Cell c) const;

  Point goal_;
  double left_ = 0;
  std::vector<Cell> cells_, beyond_;
  std::vector<Point> points_;
  Cell low_, high_;  // of the window of distances that are computed
  std::vector<std::int16_t> distance_, away_;
};

}  // namespace mrpbench::local
