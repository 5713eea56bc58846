// The map of all scans at their present poses: the share of the beams through each cell that end in it (H. P. Moravec
// and A. Elfes, "High Resolution Maps from Wide Angle Sonar", ICRA 1985, as counts). Cells have the values of
// nav_msgs/OccupancyGrid.
#pragma once

#include <array>
#include <vector>

#include "mrpbench_slam/grid.hpp"
#include "mrpbench_slam/scan.hpp"

namespace mrpbench::slam {

/// A square of the map, row by row from its lower left cell.
struct Tile {
  static constexpr int kSide = 32;
  /// In tiles from the origin of the frame.
  Cell index;
  /// -1 = unknown, 0 = free, 100 = occupied.
  std::array<std::int8_t, kSide * kSide> cells;
};

class OccupancyMap {
 public:
  OccupancyMap(double resolution, int min_pass_through, double occupancy_threshold)
      : resolution_(resolution), least_(min_pass_through), share_(occupancy_threshold) {}

  /// Insert scan `index` at a pose, where it is new or has moved by more than half a cell since it was inserted.
  void insert(std::size_t index, const Scan& scan, Pose pose);

  std::int8_t value(Cell it) const;

  /// The tiles that changed since the last call, in the order of rows, then columns.
  std::vector<Tile> changed();

 private:
  struct Counts {
    std::int32_t passed = 0, ended = 0;
  };

  void add(const Scan& scan, Pose pose, std::int32_t by);

  double resolution_;
  int least_;
  double share_;
  Grid<Counts> counts_;
  /// By tile: 1 = may have changed; by cell: the value that was returned, plus 1.
  Grid<std::uint8_t> touched_;
  Grid<std::int8_t> shown_;
  std::vector<Pose> inserted_;
};

}  // namespace mrpbench::slam
