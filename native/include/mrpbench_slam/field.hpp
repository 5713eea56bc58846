// How well a return fits a submap: the lookup table of E. B. Olson, "Real-Time Correlative Scan Matching", ICRA 2009,
// section III. A cell holds the largest of the Gaussians around occupied cells.
#pragma once

#include <array>
#include <vector>

#include "mrpbench_slam/grid.hpp"
#include "mrpbench_slam/scan.hpp"

namespace mrpbench::slam {

/// The response of a point, from 0 to 1, and how it changes with the point, per metre.
struct Response {
  double value = 0;
  Point slope;
};

class Field {
 public:
  /// Cells of side `resolution`, metres, and the deviation of returns from occupied cells, metres.
  Field(double resolution, double deviation);

  /// A cell becomes occupied: raise the responses around it.
  void raise(Cell occupied);

  /// Cells are not occupied any more: compute the responses around them again.
  template <class IsOccupied>
  void lower(Cell freed, IsOccupied&& is_occupied) {
    const int twice = 2 * radius_;
    for (int y = freed.row - radius_; y <= freed.row + radius_; ++y) {
      for (int x = freed.column - radius_; x <= freed.column + radius_; ++x) {
        if (grid_.has({x, y})) grid_.at({x, y}) = 0;
      }
    }
    const Box within{{freed.column - radius_, freed.row - radius_},
                     {freed.column + radius_ + 1, freed.row + radius_ + 1}};
    for (int y = freed.row - twice; y <= freed.row + twice; ++y) {
      for (int x = freed.column - twice; x <= freed.column + twice; ++x) {
        if (is_occupied(Cell{x, y})) stamp({x, y}, within);
      }
    }
  }

  /// The response at a point, smoothed by a quadratic B-spline so that its slope is continuous.
  Response response(Point point) const;

  const Grid<std::uint8_t>& grid() const { return grid_; }
  double resolution() const { return resolution_; }
  double deviation() const { return deviation_; }

 private:
  void stamp(Cell occupied, Box within);

  double resolution_, deviation_, per_metre_;
  int radius_;
  /// Of the Gaussian, row by row.
  std::vector<std::uint8_t> kernel_;
  Grid<std::uint8_t> grid_;
};

}  // namespace mrpbench::slam
