// A queue ordered by two small integers: least `f` first, then least `conflicts`, then newest. Without comparisons, and
// without allocation once it has grown; entries far behind the least f wait in a heap.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mrpbench::mapf {

template <class T>
class BucketQueue {
 public:
  bool empty() const { return size_ == 0 && far_.empty(); }
  /// `f` counts from the least one that will ever be pushed.
  void push(std::int32_t f, std::int32_t conflicts, const T& item) {
    if (f >= kNear) {
      far_.push_back({f, conflicts, number_++, item});
      std::push_heap(far_.begin(), far_.end());
      return;
    }
    conflicts = std::min(conflicts, kMostConflicts);
    if (f >= static_cast<std::int32_t>(rows_.size())) rows_.resize(f + 1);
    Row& row = rows_[f];
    if (conflicts >= static_cast<std::int32_t>(row.cells.size())) row.cells.resize(conflicts + 1);
    row.cells[conflicts].push_back(item);
    row.lowest = std::min(row.lowest, conflicts);
    ++row.size;
    ++size_;
    lowest_ = std::min(lowest_, f);
    highest_ = std::max(highest_, f);
  }
  /// The queue must not be empty.
  T pop() {
    if (size_ == 0) {
      std::pop_heap(far_.begin(), far_.end());
      const T item = far_.back().item;
      far_.pop_back();
      return item;
    }
    while (rows_[lowest_].size == 0) ++lowest_;
    Row& row = rows_[lowest_];
    while (row.cells[row.lowest].empty()) ++row.lowest;
    const T item = row.cells[row.lowest].back();
    row.cells[row.lowest].pop_back();
    --row.size;
    --size_;
    return item;
  }
  void clear() {
    for (std::int32_t f = 0; f <= highest_; ++f) {
      Row& row = rows_[f];
      if (row.size > 0) {
        for (auto& cell : row.cells) cell.clear();
      }
      row.size = row.lowest = 0;
    }
    far_.clear();
    size_ = 0;
    number_ = 0;
    lowest_ = kNear;
    highest_ = -1;
  }

 private:
  static constexpr std::int32_t kNear = 4096, kMostConflicts = 4095;
  struct Row {
    std::vector<std::vector<T>> cells;  // by number of conflicts
    std::int32_t lowest = 0;
    std::int32_t size = 0;
  };
  struct Far {
    std::int32_t f, conflicts;
    std::int64_t number;
    T item;
    bool operator<(const Far& other) const {  // popped later
      if (f != other.f) return f > other.f;
      if (conflicts != other.conflicts) return conflicts > other.conflicts;
      return number < other.number;
    }
  };
  std::vector<Row> rows_;
  std::vector<Far> far_;
  std::size_t size_ = 0;
  std::int64_t number_ = 0;
  std::int32_t lowest_ = kNear, highest_ = -1;
};

}  // namespace mrpbench::mapf
