#include "mrpbench_sim/walking_routes.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <queue>
#include <stdexcept>
#include <utility>

namespace mrpbench::sim {

namespace {

constexpr int kAside = 2;

struct Raster {
  std::span<const unsigned char> free;
  int rows, columns;

  bool open(int row, int column) const {
    return row >= 0 && row < rows && column >= 0 && column < columns &&
           free[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
  /// Whether all cells are free that the line between the centres of two cells touches, corners included.
  bool sees(int from, int to) const {
    int row = from / columns, column = from % columns;
    const int last_row = to / columns, last_column = to % columns;
    const int down = std::abs(last_row - row), across = std::abs(last_column - column);
    const int step_row = last_row > row ? 1 : -1, step_column = last_column > column ? 1 : -1;
    int error = across - down;
    for (int left = down + across; left > 0; --left) {
      if (!open(row, column)) return false;
      if (error > 0) {
        column += step_column;
        error -= 2 * down;
      } else if (error < 0) {
        row += step_row;
        error += 2 * across;
      } else {
        if (!open(row, column + step_column) || !open(row + step_row, column)) return false;
        row += step_row;
        column += step_column;
        error += 2 * (across - down);
        --left;
      }
    }
    return open(last_row, last_column);
  }
};

}  // namespace

std::vector<std::int32_t> walking_routes(std::span<const unsigned char> free, int rows, int columns, int goal) {
  const std::size_t cells = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  if (rows < 0 || columns < 0 || free.size() != cells) throw std::invalid_argument("the raster has another size");
  if (goal < 0 || static_cast<std::size_t>(goal) >= cells) throw std::invalid_argument("there is no such cell");
  const Raster raster{free, rows, columns};
  std::vector<std::int32_t> next(cells, -1);
  std::vector<double> way(cells, std::numeric_limits<double>::infinity());
  const auto between = [&](int a, int b) { return std::hypot(a / columns - b / columns, a % columns - b % columns); };
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  if (!free[static_cast<std::size_t>(goal)]) return next;
  next[static_cast<std::size_t>(goal)] = goal;
  way[static_cast<std::size_t>(goal)] = 0;
  open.emplace(0.0, goal);
  while (!open.empty()) {
    const auto [length, cell] = open.top();
    open.pop();
    if (length > way[static_cast<std::size_t>(cell)]) continue;
    const int row = cell / columns, column = cell % columns, corner = next[static_cast<std::size_t>(cell)];
    for (int down = -1; down <= 1; ++down) {
      for (int across = -1; across <= 1; ++across) {
        if ((!down && !across) || !raster.open(row + down, column + across)) continue;
        if (!raster.open(row + down, column) || !raster.open(row, column + across)) continue;
        const int other = (row + down) * columns + column + across;
        const auto at = static_cast<std::size_t>(other);
        const double straight = way[static_cast<std::size_t>(corner)] + between(corner, other);
        if (way[at] <= straight) continue;
        const bool seen = raster.sees(corner, other);
        const double found = seen ? straight : length + between(cell, other);
        if (found >= way[at]) continue;
        way[at] = found;
        next[at] = seen ? corner : cell;
        open.emplace(found, other);
      }
    }
  }
  for (int ring = 0; ring < kAside; ++ring) {
    const std::vector<std::int32_t> before = next;
    for (std::size_t at = 0; at < cells; ++at) {
      if (before[at] >= 0 || free[at]) continue;
      const int row = static_cast<int>(at) / columns, column = static_cast<int>(at) % columns;
      constexpr int kSides[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
      for (const auto& [down, across] : kSides) {
        if (row + down < 0 || row + down >= rows || column + across < 0 || column + across >= columns) continue;
        const int other = (row + down) * columns + column + across;
        if (before[static_cast<std::size_t>(other)] < 0) continue;
        next[at] = other;
        break;
      }
    }
  }
  return next;
}

}  // namespace mrpbench::sim
