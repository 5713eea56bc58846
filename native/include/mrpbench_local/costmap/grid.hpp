// A raster of square cells that is aligned with a raster of the whole plane.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "mrpbench_sim/geometry.hpp"

namespace mrpbench::local {

using sim::Point;
using sim::Segment;

struct Pose {
  double x = 0, y = 0, yaw = 0;
  bool operator==(const Pose&) const = default;
};

/// Metres per second ahead, radians per second counter-clockwise.
struct Twist {
  double ahead = 0, turn = 0;
  bool operator==(const Twist&) const = default;
};

/// Column and row, counted over the whole plane or within a grid.
struct Cell {
  int x = 0, y = 0;
  bool operator==(const Cell&) const = default;
};

/// The greatest integer that is not above; std::floor is a library call on the baseline machine.
inline int whole_below(double value) {
  const int cut = static_cast<int>(value);
  return cut - (value < cut ? 1 : 0);
}

/// The place of a raster of `width` x `height` cells.
struct Frame {
  int width = 0, height = 0;
  double resolution = 0.05;
  /// The plane's cell at the lower left corner.
  Cell origin;

  /// The cell within the frame that holds a point; perhaps outside.
  Cell cell(Point p) const {
    return {whole_below(p.x / resolution) - origin.x, whole_below(p.y / resolution) - origin.y};
  }
  /// Calls `put(i, cell)` with the cell of each of `count` points `at(i)`. Divisions take most of the time, so they are
  /// left out unless a quotient is so close to a whole number that a product might be rounded to another cell.
  template <class At, class Put>
  void cells(std::size_t count, At&& at, Put&& put) const {
    if (likely_cells(count, at, [&](std::size_t i, Cell c, unsigned) { put(i, c); })) return;
    for (std::size_t i = 0; i < count; ++i) put(i, cell(at(i)));
  }
  /// The same without any division. Calls `put(i, cell, close)`, where `close` is 1 if the cell may be wrong, else 0:
  /// then it is right also for points that are up to a millionth of a cell off. Tells whether it is 0 for all.
  template <class At, class Put>
  bool likely_cells(std::size_t count, At&& at, Put&& put) const {
    constexpr double kClose = 4e-6;  // the error of a product below 2^31 is smaller, 2.4e-7
    const double inverse = 1 / resolution;
    unsigned any = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Point p = at(i) * inverse;
      const Cell c{whole_below(p.x), whole_below(p.y)};
      const double x = p.x - c.x, y = p.y - c.y;
      const unsigned close = (x < kClose) | (x > 1 - kClose) | (y < kClose) | (y > 1 - kClose);
      any |= close;
      put(i, Cell{c.x - origin.x, c.y - origin.y}, close);
    }
    return any == 0;
  }
  bool holds(Cell c) const { return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height; }
  std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c.x);
  }
  Cell at(std::size_t index) const {
    const int i = static_cast<int>(index);
    return {i % width, i / width};
  }
  /// The difference of the indices of two cells that are so far from each other.
  std::ptrdiff_t step(Cell by) const { return static_cast<std::ptrdiff_t>(by.y) * width + by.x; }
  Point centre(Cell c) const { return {(c.x + origin.x + 0.5) * resolution, (c.y + origin.y + 0.5) * resolution}; }
  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// The steps of a line from one cell to another: how many along its longer side, and of these how many also along the
/// shorter one (J. E. Bresenham, "Algorithm for computer control of a digital plotter", IBM Systems Journal 4, 1965).
struct Line {
  Line(Cell a, Cell b) {
    const int dx = std::abs(b.x - a.x), dy = std::abs(b.y - a.y);
    const int sx = a.x < b.x ? 1 : -1, sy = a.y < b.y ? 1 : -1;
    const bool steep = dy > dx;
    longer = steep ? dy : dx;
    shorter = steep ? dx : dy;
    along = steep ? Cell{0, sy} : Cell{sx, 0};
    diagonal = {sx, sy};
  }

  /// Calls `visit()` at each cell, both ends included, and `step(aside)` between two of them; ends early when `visit`
  /// returns false.
  template <class Visit, class Step>
  bool walk(Visit&& visit, Step&& step) const {
    int error = longer / 2 - longer;  // from -longer to -1
    for (int i = 0;; ++i) {
      if (!visit()) return false;
      if (i == longer) return true;
      const int straight = error + shorter, back = error + (shorter - longer);
      const bool aside = straight >= 0;
      error = aside ? back : straight;
      step(aside);
    }
  }

  /// Tell whether the line passes through the cell that is so far from its beginning.
  bool holds(Cell away) const {
    const bool steep = along.x == 0;
    const int i = steep ? away.y * diagonal.y : away.x * diagonal.x;
    const int aside = steep ? away.x * diagonal.x : away.y * diagonal.y;
    const int error = longer / 2 - longer + i * shorter - aside * longer;  // of `walk` after step i, if it is there
    return i >= 0 && i <= longer && aside >= 0 && (longer == 0 ? aside == 0 : error >= -longer && error < 0);
  }

  int longer, shorter;
  Cell along, diagonal;
};

/// Calls `visit(cell)` for the cells of a line from `a` to `b`, both included; ends early when `visit` returns false.
template <class Visit>
bool line(Cell a, Cell b, Visit&& visit) {
  const Line way(a, b);
  return way.walk([&] { return visit(a); },
                  [&](bool aside) {
                    a.x += aside ? way.diagonal.x : way.along.x;
                    a.y += aside ? way.diagonal.y : way.along.y;
                  });
}

}  // namespace mrpbench::local
