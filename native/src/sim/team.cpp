#include "mrpbench_sim/team.hpp"

#include <unistd.h>

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace mrpbench::sim {

struct Team::Others {
  const pid_t process = getpid();
  std::mutex mutex;
  std::condition_variable changed;
  const Take* take = nullptr;
  std::uint64_t calls = 0;
  bool ends = false;
  /// How many are in `take`.
  std::atomic<int> busy{0};
  /// The last member, so that they end before what they use does.
  std::vector<std::jthread> threads;

  bool are_here() const { return process == getpid(); }

  void serve(std::size_t member) {
    std::uint64_t served = 0;
    std::unique_lock lock(mutex);
    while (true) {
      changed.wait(lock, [&] { return ends || (take && calls != served); });
      if (ends) return;
      served = calls;
      const auto& work = *take;
      ++busy;
      lock.unlock();
      work(member);
      --busy;
      busy.notify_one();
      lock.lock();
    }
  }
};

Team::Team(int threads) : threads_(static_cast<std::size_t>(std::max(1, threads))) {}

Team::~Team() {
  if (!others_) return;
  if (!others_->are_here()) {
    static_cast<void>(others_.release());  // a fork has no threads that could be waited for
    return;
  }
  {
    const std::lock_guard lock(others_->mutex);
    others_->ends = true;
  }
  others_->changed.notify_all();
}

void Team::run(std::size_t wanted, const Take& take) {
  if (!others_) others_ = std::make_unique<Others>();
  Others& it = *others_;
  if (!it.are_here()) return take(0);
  while (it.threads.size() + 1 < wanted) {
    it.threads.emplace_back([&it, member = it.threads.size() + 1] { it.serve(member); });
  }
  {
    const std::lock_guard lock(it.mutex);
    it.take = &take;
    ++it.calls;
  }
  it.changed.notify_all();
  take(0);
  {
    const std::lock_guard lock(it.mutex);
    it.take = nullptr;  // one that wakes up from now on is late, and nobody waits for it
  }
  for (int busy = it.busy; busy > 0; busy = it.busy) it.busy.wait(busy);
}

}  // namespace mrpbench::sim
