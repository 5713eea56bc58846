// An open list with a focal list inside, for small integer costs: states within the bound are ordered by (row, column),
// among equals the newest comes first; the others wait in lists by f. Pearl and Kim, "Studies in semi-admissible
// heuristics", IEEE PAMI 1982, with buckets instead of heaps. A state that is reached again in a better way has several
// entries; the caller ignores all but the first that is taken out.
#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

class FocalQueue {
 public:
  static constexpr std::size_t kEntryBytes = 12;

  /// Empty, with all f at least `least_f`, and entries up to `bound` in the focal list.
  void reset(Tick least_f, Tick bound);
  /// Count a state with this f, which must not be less than `least_f` has been; `close` when it is expanded.
  void open(Tick f) {
    const auto place = static_cast<std::size_t>(f - base_);
    if (place >= open_.size()) open_.resize(place + 1, 0);
    if (place >= waiting_.size()) waiting_.resize(place + 1);
    ++open_[place];
    ++size_;
  }
  void close(Tick f) {
    --open_[f - base_];
    --size_;
  }
  /// Add an entry for a state that is open. `row` and `column` order the focal list.
  void push(std::int32_t entry, Tick f, int row, int column) {
    const Waiting it{entry, std::min(row, kRows - 1), column};
    if (f > bound_) {
      waiting_[f - base_].push_back(it);
    } else {
      enter(it);
    }
  }
  /// Take out the first entry of the focal list, which must not be empty.
  std::int32_t pop() {
    for (;; ++first_row_) {
      Row& row = rows_[first_row_];
      while (row.first < row.mask.size() && row.mask[row.first] == 0) ++row.first;
      if (row.first >= row.mask.size()) continue;
      std::uint64_t& mask = row.mask[row.first];
      std::vector<std::int32_t>& cell = row.cells[row.first * 64 + std::countr_zero(mask)];
      const std::int32_t entry = cell.back();
      cell.pop_back();
      if (cell.empty()) mask &= mask - 1;
      return entry;
    }
  }

  /// Tell whether no state is open.
  bool empty() const { return size_ == 0; }
  /// Least f of the open states, of which there must be one.
  Tick least_f();
  /// Let all entries with f <= bound into the focal list.
  void raise(Tick bound);

 private:
  static constexpr int kRows = 256;  // greater ones share the last
  struct Row {
    std::vector<std::vector<std::int32_t>> cells;  // entries by column
    std::vector<std::uint64_t> mask;               // columns with entries
    std::size_t first = 0;                         // words of `mask` before this one are zero
  };
  struct Waiting {
    std::int32_t entry, row, column;
  };
  static_assert(sizeof(Waiting) == kEntryBytes);
  void enter(const Waiting& it) {
    for (; used_rows_ <= it.row; ++used_rows_) rows_[used_rows_].first = 0;
    Row& row = rows_[it.row];
    const auto column = static_cast<std::size_t>(it.column), word = column / 64;
    if (word >= row.mask.size()) {
      row.cells.resize((word + 1) * 64);
      row.mask.resize(word + 1, 0);
    }
    row.cells[column].push_back(it.entry);
    row.mask[word] |= std::uint64_t{1} << (column % 64);
    row.first = std::min(row.first, word);
    first_row_ = std::min(first_row_, it.row);
  }

  std::vector<Row> rows_ = std::vector<Row>(kRows);
  int first_row_ = kRows, used_rows_ = 0;
  std::vector<std::vector<Waiting>> waiting_;  // by f - base_, beyond the bound
  std::vector<std::int32_t> open_;             // by f - base_: number of states
  Tick base_ = 0, least_ = 0, bound_ = 0;
  std::size_t size_ = 0;
};

}  // namespace mrpbench::mapf
