// The ways of people to a place: where to walk next from each cell of a raster, round corners in straight lines.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace mrpbench::sim {

/// For each cell of a raster of `rows` × `columns`, row by row, the cell to which to walk straight on the way to
/// `goal`; -1 = there is none. Theta* (A. Nash et al., AAAI 2007) from the goal to all free cells. A cell that is not
/// free leads to a free one next to it, at most two cells away.
std::vector<std::int32_t> walking_routes(std::span<const unsigned char> free, int rows, int columns, int goal);

}  // namespace mrpbench::sim
