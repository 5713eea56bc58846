#include "mrpbench_sim/team.hpp"

namespace mrpbench::sim {

Team::~Team() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
}

void Team::run(std::size_t wanted, const std::function<void()>& take) {
  while (others_.size() + 1 < wanted) others_.emplace_back([this] { serve(); });
  {
    const std::lock_guard lock(mutex_);
    take_ = &take;
    ++calls_;
  }
  changed_.notify_all();
  take();
  {
    const std::lock_guard lock(mutex_);
    take_ = nullptr;  // one that wakes up from now on is late, and nobody waits for it
  }
  for (int busy = busy_; busy > 0; busy = busy_) busy_.wait(busy);
}

void Team::serve() {
  std::uint64_t served = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ends_ || (take_ && calls_ != served); });
    if (ends_) return;
    served = calls_;
    const auto& take = *take_;
    ++busy_;
    lock.unlock();
    take();
    --busy_;
    busy_.notify_one();
    lock.lock();
  }
}

}  // namespace mrpbench::sim
