// A grid that grows: cells of equal squares, addressed by their indices in a frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace mrpbench::slam {

struct Cell {
  int column = 0, row = 0;
  bool operator==(const Cell&) const = default;
};

/// The cells from `low` up to and not including `high`.
struct Box {
  Cell low, high;
  bool has(Cell it) const {
    return it.column >= low.column && it.row >= low.row && it.column < high.column && it.row < high.row;
  }
  int columns() const { return high.column - low.column; }
  int rows() const { return high.row - low.row; }
};

inline int floor_index(double value) {
  return static_cast<int>(std::floor(value));
}

template <class T>
class Grid {
 public:
  /// Cells that are not there yet; the grid grows by blocks of this many columns and rows.
  static constexpr int kBlock = 64;

  const Box& box() const { return box_; }
  bool has(Cell it) const { return box_.has(it); }
  T& at(Cell it) { return cells_[index(it)]; }
  const T& at(Cell it) const { return cells_[index(it)]; }
  /// A cell, or `T{}` outside of the grid.
  T value(Cell it) const { return has(it) ? at(it) : T{}; }
  const T* row(int row) const { return cells_.data() + index({box_.low.column, row}); }
  T* row(int row) { return cells_.data() + index({box_.low.column, row}); }

  /// Make the grid contain a box.
  void cover(Box wanted) {
    if (cells_.empty()) box_ = {down(wanted.low), down(wanted.low)};
    const Box grown{{std::min(box_.low.column, down(wanted.low).column), std::min(box_.low.row, down(wanted.low).row)},
                    {std::max(box_.high.column, up(wanted.high).column), std::max(box_.high.row, up(wanted.high).row)}};
    if (grown.low == box_.low && grown.high == box_.high) return;
    std::vector<T> cells(static_cast<std::size_t>(grown.columns()) * static_cast<std::size_t>(grown.rows()));
    for (int y = box_.low.row; y < box_.high.row; ++y) {
      const auto to = static_cast<std::size_t>(y - grown.low.row) * static_cast<std::size_t>(grown.columns()) +
                      static_cast<std::size_t>(box_.low.column - grown.low.column);
      std::copy_n(row(y), box_.columns(), cells.begin() + static_cast<std::ptrdiff_t>(to));
    }
    cells_ = std::move(cells);
    box_ = grown;
  }

  void clear() {
    cells_ = {};
    box_ = {};
  }

 private:
  static int down(int value) { return (value >= 0 ? value : value - kBlock + 1) / kBlock * kBlock; }
  static Cell down(Cell it) { return {down(it.column), down(it.row)}; }
  static Cell up(Cell it) { return {down(it.column + kBlock - 1), down(it.row + kBlock - 1)}; }
  std::size_t index(Cell it) const {
    return static_cast<std::size_t>(it.row - box_.low.row) * static_cast<std::size_t>(box_.columns()) +
           static_cast<std::size_t>(it.column - box_.low.column);
  }

  Box box_;
  std::vector<T> cells_;
};

/// Calls `visit` for each cell that the straight line from one point to another passes, both in cells, without the last
/// cell (J. Amanatides and A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987).
template <class Visit>
void traverse(double from_x, double from_y, double to_x, double to_y, Visit&& visit) {
  Cell at{floor_index(from_x), floor_index(from_y)};
  const Cell last{floor_index(to_x), floor_index(to_y)};
  const double dx = to_x - from_x, dy = to_y - from_y;
  const int step_x = dx > 0 ? 1 : -1, step_y = dy > 0 ? 1 : -1;
  const double far = 1e300;
  const double across = dx != 0 ? 1 / std::abs(dx) : far, up = dy != 0 ? 1 / std::abs(dy) : far;
  double next_x = dx != 0 ? (dx > 0 ? at.column + 1 - from_x : from_x - at.column) * across : far;
  double next_y = dy != 0 ? (dy > 0 ? at.row + 1 - from_y : from_y - at.row) * up : far;
  for (int left = std::abs(last.column - at.column) + std::abs(last.row - at.row); left > 0; --left) {
    visit(at);
    if (next_x < next_y) {
      at.column += step_x;
      next_x += across;
    } else {
      at.row += step_y;
      next_y += up;
    }
  }
}

}  // namespace mrpbench::slam
