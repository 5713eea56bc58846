// The free cells of a raster, and the cell ahead of each.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mrpbench::discrete {

/// The action of a robot in one step. Headings count clockwise from east: 0 east, 1 south, 2 west, 3 north.
enum class Action : std::uint8_t { forward = 'F', clockwise = 'R', counter_clockwise = 'C', wait = 'W', late = 'T' };

/// A free cell, by its number among the free cells, and a heading.
struct Pose {
  std::int32_t cell;
  std::int32_t heading;
  bool operator==(const Pose&) const = default;
};

class Grid {
 public:
  /// `blocked` row by row from the top. Throws std::invalid_argument if the sizes do not agree.
  Grid(std::span<const std::uint8_t> blocked, int height, int width);

  int size() const { return static_cast<int>(place_.size()); }
  int width() const { return width_; }
  int height() const { return height_; }
  /// Number of a free cell; -1 = blocked or outside.
  int free_cell(std::int64_t place) const {
    return place < 0 || place >= static_cast<std::int64_t>(number_.size()) ? -1 : number_[place];
  }
  /// Row * width + column of a free cell.
  int place(int cell) const { return place_[cell]; }
  /// The free cell ahead; -1 = a wall.
  int ahead(int cell, int heading) const { return ahead_[cell][heading]; }
  int ahead(const Pose& pose) const { return ahead_[pose.cell][pose.heading]; }
  int manhattan(int a, int b) const;
  /// The pose after an action; forward into a wall stays.
  Pose after(const Pose& pose, Action action) const;

 private:
  int height_, width_;
  std::vector<std::int32_t> number_, place_;
  std::vector<std::array<std::int32_t, 4>> ahead_;
};

}  // namespace mrpbench::discrete
