// Arrays that live as long as a solver, allocated in large blocks: stable addresses, no allocation per node.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "mrpbench_mapf/common/limits.hpp"

namespace mrpbench::mapf {

template <class T>
class Arena {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  explicit Arena(Limits& limits) : limits_(limits) {}

  std::span<T> copy(std::span<const T> items) {
    if (items.size() > free_) grow(items.size());
    T* place = next_;
    std::uninitialized_copy(items.begin(), items.end(), place);
    next_ += items.size();
    free_ -= items.size();
    return {place, items.size()};
  }
  T& copy(const T& item) { return copy(std::span<const T>(&item, 1)).front(); }
  /// Forget everything, keep the blocks for what comes next.
  void clear() {
    used_blocks_ = 0;
    next_ = nullptr;
    free_ = 0;
  }

 private:
  struct Free {
    void operator()(void* block) const { std::free(block); }
  };
  struct Block {
    std::unique_ptr<void, Free> memory;
    std::size_t bytes;
  };

  void grow(std::size_t wanted) {
    while (used_blocks_ < blocks_.size()) {
      const Block& block = blocks_[used_blocks_++];
      if (block.bytes / sizeof(T) >= wanted) return use(block);
    }
    const std::size_t unit = blocks_.size() < kSmallBlocks ? kSmall : kHuge;
    const std::size_t bytes = (wanted * sizeof(T) + unit - 1) / unit * unit;
    limits_.charge(bytes);
    void* block = std::aligned_alloc(unit, bytes);
    if (block == nullptr) throw std::bad_alloc();
    blocks_.push_back({std::unique_ptr<void, Free>(block), bytes});
    used_blocks_ = blocks_.size();
#ifdef MADV_HUGEPAGE
    // Giving gigabytes back to the system page by page takes seconds, past the deadline; huge pages take none.
    if (unit == kHuge) madvise(block, bytes, MADV_HUGEPAGE);
#endif
    use(blocks_.back());
  }
  void use(const Block& block) {
    next_ = static_cast<T*>(block.memory.get());
    free_ = block.bytes / sizeof(T);
  }

  static constexpr std::size_t kSmall = 1 << 16;
  static constexpr std::size_t kHuge = 1 << 21;
  static constexpr std::size_t kSmallBlocks = 16;
  Limits& limits_;
  std::vector<Block> blocks_;
  std::size_t used_blocks_ = 0;
  T* next_ = nullptr;
  std::size_t free_ = 0;
};

}  // namespace mrpbench::mapf
