// What a search knows of each pair of a vertex and a tick: a hash table with open addressing that the next search
// clears at once, and that is small at first so that it stays in the cache.
#pragma once

#include <algorithm>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

class StateTable {
 public:
  explicit StateTable(Limits& limits) : limits_(limits) { use(kSmall); }

  static constexpr std::int32_t kUnknown = 1 << 30;

  void clear() { use(kSmall); }
  /// The value of a state, `kUnknown` at first; the reference is valid until the next call.
  std::int32_t& operator()(std::int32_t vertex, Tick tick) {
    if (2 * size_ > mask_) grow();
    const std::uint32_t mixed =
        static_cast<std::uint32_t>(vertex) * 0x9E3779B1u + static_cast<std::uint32_t>(tick) * 0x85EBCA77u;
    std::size_t place = (mixed ^ mixed >> 15) & mask_;
    while (slots_[place].epoch == epoch_ && (slots_[place].vertex != vertex || slots_[place].tick != tick)) {
      place = (place + 1) & mask_;
    }
    if (slots_[place].epoch != epoch_) {
      ++size_;
      slots_[place] = {epoch_, vertex, tick, kUnknown};
    }
    return slots_[place].value;
  }

 private:
  static constexpr std::size_t kSmall = 1 << 12;
  struct Slot {
    std::uint32_t epoch;  // of the search that filled it
    std::int32_t vertex;
    Tick tick;
    std::int32_t value;
  };

  /// Forget everything and use the first `slots`.
  void use(std::size_t slots) {
    if (slots > slots_.size()) {
      limits_.charge((slots - slots_.size()) * sizeof(Slot));
      slots_.resize(slots);
    }
    if (++epoch_ == 0) {
      std::ranges::fill(slots_, Slot{});
      epoch_ = 1;
    }
    mask_ = slots - 1;
    size_ = 0;
  }
  void grow() {
    std::vector<Slot> old;
    std::copy_if(slots_.begin(), slots_.begin() + mask_ + 1, std::back_inserter(old),
                 [&](const Slot& it) { return it.epoch == epoch_; });
    use(4 * (mask_ + 1));
    for (const Slot& it : old) (*this)(it.vertex, it.tick) = it.value;
  }

  Limits& limits_;
  std::vector<Slot> slots_;
  std::size_t mask_ = 0, size_ = 0;
  std::uint32_t epoch_ = 0;
};

}  // namespace mrpbench::mapf
