// The lethal cells of a costmap, for questions about small windows.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "mrpbench_local/costmap/grid.hpp"

namespace mrpbench::local {

/// One bit for each cell of a frame, so that the rows of a window in which nothing is lethal are passed at once.
class LethalCells {
 public:
  void find(const Frame& frame, const std::vector<std::uint8_t>& costs);

  /// Calls `visit(cell)` for those from `low` to `high`, row by row, until it returns false; cells outside of the frame
  /// do not matter.
  template <class Visit>
  bool each(Cell low, Cell high, Visit&& visit) const {
    const int left = std::max(0, low.x), right = std::min(width_ - 1, high.x);
    if (left > right) return true;
    for (int y = std::max(0, low.y); y <= std::min(height_ - 1, high.y); ++y) {
      const std::uint64_t* const row = &words_[static_cast<std::size_t>(y) * stride_];
      for (int word = left / 64; word <= right / 64; ++word) {
        std::uint64_t bits = row[word];
        if (word == left / 64) bits &= ~std::uint64_t{0} << left % 64;
        if (word == right / 64) bits &= ~std::uint64_t{0} >> (63 - right % 64);
        for (; bits; bits &= bits - 1) {
          if (!visit(Cell{64 * word + std::countr_zero(bits), y})) return false;
        }
      }
    }
    return true;
  }

 private:
  int width_ = 0, height_ = 0;
  std::size_t stride_ = 0;  // words of a row
  std::vector<std::uint64_t> words_;
};

}  // namespace mrpbench::local
