// What an update of a costmap needs for a while.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mrpbench_local/costmap/beams.hpp"
#include "mrpbench_local/costmap/cell_set.hpp"

namespace mrpbench::local {

/// Shared by the costmaps that a thread updates one after the other, so that they stay in its cache.
struct UpdateBuffers {
  /// Costs with room for stamps all around.
  std::vector<std::uint8_t> margined;
  /// The lethal cells whose costs are not written along their row.
  CellSet alone;
  /// The cells that the scan marks, and by cell the shortest beam that ends there; none between scans.
  CellSet hit;
  struct Nearest {
    float range = std::numeric_limits<float>::infinity();
    std::int32_t beam = 0;
  };
  std::vector<Nearest> nearest;
  /// The marks that are older than the scan.
  std::vector<Cell> old;
  Beams beams;
  std::vector<double> lengths;
  std::vector<Cell> ends;

  /// Those of the calling thread. Not inline: a compiler would look them up again at each use.
  static UpdateBuffers& of_thread();
};

}  // namespace mrpbench::local
