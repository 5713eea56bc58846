// Threads that share work.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace mrpbench::sim {

/// The calling thread and others, which sleep between calls: to begin a thread takes as long as the commands of ten
/// robots, and what belongs to a thread would be made anew each time. The others begin with the first call that has
/// work for them. In a process that is forked off from there on, one thread does all work.
class Team {
 public:
  using Work = std::function<void(std::size_t)>;

  explicit Team(int threads);
  /// Of work that was begun, what no thread has taken yet is not done.
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Call `work(i)` once for every i below `count`. Each thread has a part of them, the same in each call of this size,
  /// so that what belongs to one i stays in the cache of a core; then it takes what is left of the others' parts, so
  /// that none waits for another whose work takes longer. Rethrows the exception of the lowest i that threw one. Calls
  /// must not overlap.
  void share(std::size_t count, const Work& work) {
    begin(count, std::cref(work));
    finish();
  }
  /// The same in two calls, between which the calling thread does something else. What `work` refers to must last until
  /// `finish`. Finishes what was begun before. A single thread does all work here and now.
  void begin(std::size_t count, Work work);
  /// Take part in what was begun, until all is done.
  void finish();

 private:
  struct Call;
  struct Others;

  std::size_t threads_;
  std::unique_ptr<Call> call_;
  /// After what they take part in, so that they end before.
  std::unique_ptr<Others> others_;
};

}  // namespace mrpbench::sim
