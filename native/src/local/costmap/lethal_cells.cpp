#include "mrpbench_local/costmap/lethal_cells.hpp"

#include "local/next_byte.hpp"
#include "mrpbench_local/costmap/costmap.hpp"

namespace mrpbench::local {

void LethalCells::find(const Frame& frame, const std::vector<std::uint8_t>& costs) {
  width_ = frame.width;
  height_ = frame.height;
  stride_ = static_cast<std::size_t>(width_ + 63) / 64;
  words_.assign(stride_ * static_cast<std::size_t>(height_), 0);
  for (std::size_t i = 0; (i = next_byte(costs.data(), kLethal, i, costs.size())) < costs.size(); ++i) {
    const Cell c = frame.at(i);
    words_[static_cast<std::size_t>(c.y) * stride_ + static_cast<std::size_t>(c.x / 64)] |= std::uint64_t{1}
                                                                                            << c.x % 64;
  }
}

}  // namespace mrpbench::local
