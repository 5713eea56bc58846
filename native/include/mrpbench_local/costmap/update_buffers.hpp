// What an update of a costmap needs for a while.
#pragma once

#include <cstdint>
#include <vector>

#include "mrpbench_local/costmap/beams.hpp"

namespace mrpbench::local {

/// Shared by the costmaps that a thread updates one after the other, so that they stay in its cache.
struct UpdateBuffers {
  std::vector<std::uint8_t> marks;
  std::vector<std::size_t> lethal;
  /// Costs with room for stamps all around.
  std::vector<std::uint8_t> margined;
  /// `kLethal` for the lethal cells whose costs are not written along their row.
  std::vector<std::uint8_t> alone;
  Beams beams;
  std::vector<double> lengths;
  std::vector<Cell> ends;

  /// Those of the calling thread. Not inline: a compiler would look them up again at each use.
  static UpdateBuffers& of_thread();
};

}  // namespace mrpbench::local
