// Rows of items by vertex or edge, each made when a search first touches its place; the next search forgets them all
// without looking at the places that this one did not touch.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"

namespace mrpbench::mapf {

template <class T>
class LazyRows {
 public:
  /// Indices of items, which keep them until all are forgotten; references to them may end with the next row.
  struct Row {
    std::int32_t first, last;  // the last one is not of the row
    std::int32_t size() const { return last - first; }
  };

  LazyRows(int places, Limits& limits) : limits_(limits) {
    limits.charge(static_cast<std::size_t>(places) * sizeof(Slot));
    slots_.resize(places);
  }

  void forget() {
    items_.clear();
    if (++search_ > 0) return;
    std::ranges::fill(slots_, Slot{});  // after an overflow old numbers would look new
    search_ = 1;
  }
  /// The row of `place`; if it is not known, `make(items)` appends its items.
  template <class Make>
  Row row(int place, Make make) {
    Slot& slot = slots_[place];
    if (slot.search == search_) return slot.row;
    const auto first = static_cast<std::int32_t>(items_.size());
    make(items_);
    limits_.charge_growth(counted_, items_.capacity() * sizeof(T));
    slot = {search_, {first, static_cast<std::int32_t>(items_.size())}};
    return slot.row;
  }
  std::span<const T> items(Row row) const { return {items_.data() + row.first, static_cast<std::size_t>(row.size())}; }
  T& operator[](int item) { return items_[item]; }
  const T& operator[](int item) const { return items_[item]; }

 private:
  struct Slot {
    std::uint32_t search = 0;  // that made the row
    Row row{0, 0};
  };

  Limits& limits_;
  std::vector<Slot> slots_;
  std::vector<T> items_;
  std::uint32_t search_ = 1;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
