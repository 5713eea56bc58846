// Work that threads share.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace mrpbench::sim {

/// Call `work(i)` once for every i below `count`, in several threads, of which this is one. Each takes the next i, so
/// that none waits for another whose work takes longer. Rethrows the exception of the lowest i that threw one.
template <class Work>
void share(std::size_t count, int threads, Work&& work) {
  const std::size_t used = std::min(static_cast<std::size_t>(std::max(1, threads)), count);
  if (used < 2) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  std::vector<std::exception_ptr> failures(count);
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        failures[i] = std::current_exception();
        return;
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < used; ++t) others.emplace_back(take);
    take();
  }
  for (const auto& it : failures) {
    if (it) std::rethrow_exception(it);
  }
}

}  // namespace mrpbench::sim
