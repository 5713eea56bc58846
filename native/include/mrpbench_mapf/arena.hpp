// Arrays that live as long as a solver, allocated in large blocks: stable addresses, no allocation per node.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "mrpbench_mapf/limits.hpp"

namespace mrpbench::mapf {

template <class T>
class Arena {
 public:
  explicit Arena(Limits& limits) : limits_(limits) {}

  std::span<T> copy(std::span<const T> items) {
    if (items.size() > free_) grow(items.size());
    T* place = next_;
    std::copy(items.begin(), items.end(), place);
    next_ += items.size();
    free_ -= items.size();
    return {place, items.size()};
  }
  T& copy(const T& item) { return copy(std::span<const T>(&item, 1)).front(); }

 private:
  void grow(std::size_t wanted) {
    const std::size_t size = std::max<std::size_t>(wanted, std::max<std::size_t>(1, kBlockBytes / sizeof(T)));
    limits_.charge(size * sizeof(T));
    blocks_.push_back(std::make_unique<T[]>(size));
    next_ = blocks_.back().get();
    free_ = size;
  }

  static constexpr std::size_t kBlockBytes = 1 << 16;
  Limits& limits_;
  std::vector<std::unique_ptr<T[]>> blocks_;
  T* next_ = nullptr;
  std::size_t free_ = 0;
};

}  // namespace mrpbench::mapf
