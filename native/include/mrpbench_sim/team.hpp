// Threads that share work.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <vector>

namespace mrpbench::sim {

/// The calling thread and others, which sleep between calls: to begin a thread takes as long as the commands of ten
/// robots, and what belongs to a thread would be made anew each time. The others begin with the first call that has
/// work for them. In a process that is forked off from there on, one thread does all work.
class Team {
 public:
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Call `work(i)` once for every i below `count`. Each thread has a part of them, the same in each call of this size,
  /// so that what belongs to one i stays in the cache of a core; then it takes what is left of the others' parts, so
  /// that none waits for another whose work takes longer. Rethrows the exception of the lowest i that threw one. Calls
  /// must not overlap.
  template <class Work>
  void share(std::size_t count, Work&& work) {
    const std::size_t wanted = std::min(threads_, count);
    if (wanted < 2) {
      for (std::size_t i = 0; i < count; ++i) work(i);
      return;
    }
    std::vector<std::exception_ptr> failures(count);
    std::vector<Part> parts(wanted);
    for (std::size_t k = 0; k < wanted; ++k) {
      parts[k].next = k * count / wanted;
      parts[k].end = (k + 1) * count / wanted;
    }
    run(wanted, [&](std::size_t member) {
      for (std::size_t k = 0; k < wanted; ++k) {
        Part& part = parts[(member + k) % wanted];
        for (std::size_t i = part.next++; i < part.end; i = part.next++) {
          try {
            work(i);
          } catch (...) {
            failures[i] = std::current_exception();
            return;
          }
        }
      }
    });
    for (const auto& it : failures) {
      if (it) std::rethrow_exception(it);
    }
  }

 private:
  /// Numbers that one thread takes first. The calling thread begins with the lowest and goes on upwards, so all below
  /// one at which it fails are taken.
  struct alignas(64) Part {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };
  /// The other threads and what they wait for.
  struct Others;
  /// What a member does; the calling thread is member 0.
  using Take = std::function<void(std::size_t member)>;

  /// Call `take` in this thread and in those of at least `wanted` - 1 others that wake up before it returns here.
  void run(std::size_t wanted, const Take& take);

  std::size_t threads_;
  std::unique_ptr<Others> others_;
};

}  // namespace mrpbench::sim
