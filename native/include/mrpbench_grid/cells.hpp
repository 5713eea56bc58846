// Robots on padded maps of cells: where they are after a step, how far cells are from a goal, and what robots perceive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mrpbench::grid {

/// The number of a cell in the padded maps of a batch of environments, row by row, one map after the other.
using Place = std::int64_t;

/// How far a cell is from a goal that cannot be reached from it.
inline constexpr std::int32_t unreachable = 1 << 20;

/// The maps of a batch of environments, all of one shape, and memory for the calls below, which is clean between them.
class Cells {
 public:
  /// `blocked` holds `height * width` cells of each map. It is read in each call, and may change between two calls.
  Cells(std::span<const std::uint8_t> blocked, Place height, Place width);

  std::size_t size() const { return blocked_.size(); }
  Place height() const { return height_; }
  Place width() const { return width_; }

  /// Writes where robots at `place` are after a step in which they want to be at `wish`, by the rule `soft` of POGEMA
  /// (Skrynnik et al., ICLR 2025): robots that want to change places stay; of several that want one cell the first gets
  /// it; a robot that would come to a wall or to the cell of a robot that stays, stays as well. Robots that are not
  /// active stay and block no others. Returns how many active robots are not where they want to be.
  std::size_t soft(std::span<const bool> active, std::span<const Place> place, std::span<const Place> wish,
                   std::span<Place> to);

  /// Writes which active robots enter the cell of an active one with a higher index.
  void overwritten(std::span<const bool> active, std::span<const Place> place, std::span<const Place> to,
                   std::span<bool> found);

  /// Writes which of the actions stay, up, down, left, right lead to a free cell, as the bits 1, 2, 4, 8 and 16.
  void free_actions(std::span<const Place> place, std::span<std::uint8_t> bits) const;

  /// Writes the steps of a shortest way from each cell of the goal's map to the goal, `unreachable` where there is
  /// none.
  void distances(Place goal, std::span<std::int32_t> steps);

  /// Writes POGEMA's observation `default` of each robot, three windows of 2 * radius + 1 rows and columns around its
  /// place: 1 at obstacles, 1 at robots that are `shown`, and 1 at the goal, which is moved onto the border of the
  /// window where it lies outside. All windows must lie in the maps.
  void pogema(std::span<const bool> shown, std::span<const Place> place, std::span<const Place> goal, Place radius,
              std::span<float> windows);

 private:
  void enter(std::span<const bool> active, std::span<const Place> place);
  void leave(std::span<const Place> place);

  std::span<const std::uint8_t> blocked_;
  Place height_, width_;
  std::vector<std::int32_t> occupant_;  // the robot at each place, -1 = none
  std::vector<std::int32_t> winner_;    // the robot that may enter each place, -1 = none
  std::vector<std::uint8_t> shown_;
  std::vector<std::uint8_t> stays_;
  std::vector<std::int32_t> queue_;
};

}  // namespace mrpbench::grid
