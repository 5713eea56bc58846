#include "mrpbench_local/costmap/cell_set.hpp"

namespace mrpbench::local {

void CellSet::begin(const Frame& frame) {
  width_ = frame.width;
  height_ = frame.height;
  stride_ = static_cast<std::size_t>(width_ + 63) / 64;
  words_.assign(stride_ * static_cast<std::size_t>(height_), 0);
}

void CellSet::move(Cell by) {
  const auto moved = [this](std::uint64_t* row, int x) {
    const std::size_t words = static_cast<std::size_t>(std::abs(x)) / 64;
    const int bits = std::abs(x) % 64;
    const auto at = [&](std::size_t word) { return word < stride_ ? row[word] : 0; };
    for (std::size_t k = 0; k < stride_; ++k) {
      // A row that moves left is filled from its left end, one that moves right from its right end.
      const std::size_t word = x < 0 ? k : stride_ - 1 - k;
      const std::size_t from = x < 0 ? word + words : word - words, next = x < 0 ? from + 1 : from - 1;
      const std::uint64_t near = x < 0 ? at(from) >> bits : at(from) << bits;
      const std::uint64_t far = bits == 0 ? 0 : x < 0 ? at(next) << (64 - bits) : at(next) >> (64 - bits);
      row[word] = near | far;
    }
    if (width_ % 64 != 0) row[stride_ - 1] &= (std::uint64_t{1} << width_ % 64) - 1;
  };
  for (int k = 0; k < height_; ++k) {
    const int y = by.y < 0 ? k : height_ - 1 - k, from = y - by.y;
    std::uint64_t* const row = row_of(y);
    if (from < 0 || from >= height_ || std::abs(by.x) >= width_) {
      std::fill_n(row, stride_, 0);
      continue;
    }
    if (from != y) std::copy_n(row_of(from), stride_, row);
    moved(row, by.x);
  }
}

}  // namespace mrpbench::local
