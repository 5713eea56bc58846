// Lower bounds of distances on large maps.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mrpbench_discrete/grid.hpp"

namespace mrpbench::discrete {

/// The landmarks of ALT (Goldberg and Harrelson, "Computing the Shortest Path: A* Search Meets Graph Theory", SODA
/// 2005): the moves between two cells are at least the difference of their distances from any landmark. Each landmark
/// is the cell that is farthest from those before it.
class Landmarks {
 public:
  /// Landmarks among the cells that are reachable from `cell`.
  Landmarks(const Grid& grid, int cell);

  /// Moves from one cell to another, at least.
  std::uint32_t bound(int a, int b) const;

 private:
  static constexpr int kLandmarks = 8;
  static constexpr std::uint16_t kFar = 0xffff;
  ///< Not reachable, or farther than that.

  std::vector<std::int32_t> distances(int from) const;

  const Grid& grid_;
  std::vector<std::array<std::uint16_t, kLandmarks>> distance_;
};

}  // namespace mrpbench::discrete
