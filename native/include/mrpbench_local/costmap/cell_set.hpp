// A set of cells of a frame.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "mrpbench_local/costmap/grid.hpp"

namespace mrpbench::local {

/// One bit for each cell, so that the rows of a window in which there are none are passed at once.
class CellSet {
 public:
  /// The empty set of a frame of this size.
  void begin(const Frame& frame);

  bool holds(Cell c) const { return word_of(c) >> c.x % 64 & 1; }
  void insert(Cell c) { word_of(c) |= std::uint64_t{1} << c.x % 64; }
  /// Insert all of another set of the same frame.
  void insert(const CellSet& others) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= others.words_[i];
  }
  void erase(Cell c) { word_of(c) &= ~(std::uint64_t{1} << c.x % 64); }
  /// Move all cells by columns and rows; those that leave the frame are no longer in it.
  void move(Cell by);

  /// The first column from `x` on of a row that is in the set, or is not; the width if there is none.
  int next_in(int x, int y) const { return next(x, y, 0); }
  int next_out(int x, int y) const { return std::min(width_, next(x, y, ~std::uint64_t{0})); }

  /// Calls `visit(cell)` for all, row by row.
  template <class Visit>
  void each(Visit&& visit) const {
    each_but(nullptr, visit);
  }
  /// Calls `visit(cell)` for those that are not in a set of the same frame.
  template <class Visit>
  void each_not_in(const CellSet& others, Visit&& visit) const {
    each_but(others.words_.data(), visit);
  }
  /// Calls `visit(cell)` for those from `low` to `high`, row by row, until it returns false; cells outside of the frame
  /// do not matter.
  template <class Visit>
  bool each(Cell low, Cell high, Visit&& visit) const {
    const int left = std::max(0, low.x), right = std::min(width_ - 1, high.x);
    if (left > right) return true;
    for (int y = std::max(0, low.y); y <= std::min(height_ - 1, high.y); ++y) {
      const std::uint64_t* const row = row_of(y);
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
  const std::uint64_t* row_of(int y) const { return &words_[static_cast<std::size_t>(y) * stride_]; }
  std::uint64_t* row_of(int y) { return &words_[static_cast<std::size_t>(y) * stride_]; }
  const std::uint64_t& word_of(Cell c) const { return row_of(c.y)[c.x / 64]; }
  std::uint64_t& word_of(Cell c) { return row_of(c.y)[c.x / 64]; }

  /// The first column from `x` on whose bit differs from those of `same`.
  int next(int x, int y, std::uint64_t same) const {
    if (x >= width_) return width_;
    const std::uint64_t* const row = row_of(y);
    std::uint64_t bits = (row[x / 64] ^ same) & ~std::uint64_t{0} << x % 64;
    std::size_t word = static_cast<std::size_t>(x) / 64;
    while (bits == 0 && ++word < stride_) bits = row[word] ^ same;
    return bits == 0 ? width_ : static_cast<int>(64 * word) + std::countr_zero(bits);
  }

  template <class Visit>
  void each_but(const std::uint64_t* others, Visit&& visit) const {
    std::size_t at = 0;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; x += 64, ++at) {
        for (std::uint64_t bits = others ? words_[at] & ~others[at] : words_[at]; bits; bits &= bits - 1) {
          visit(Cell{x + std::countr_zero(bits), y});
        }
      }
    }
  }

  int width_ = 0, height_ = 0;
  std::size_t stride_ = 0;  // words of a row
  std::vector<std::uint64_t> words_;
};

}  // namespace mrpbench::local
