#include "mrpbench_sim/team.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace mrpbench::sim {

namespace {

/// For how long a thread looks for what it waits for before it sleeps: to wake up one costs each of the two 20
/// microseconds, and the calls of a control period are less than this apart.
constexpr std::chrono::microseconds kPatience(200);

/// Wait until something holds, but not for long; let others run in the meantime.
template <class Condition>
void look(const Condition& holds) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!holds() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
}

}  // namespace

/// Work that threads share.
struct Team::Call {
  /// Numbers that one thread takes first. The calling thread begins with the lowest and goes on upwards, so all below
  /// one at which it fails are taken.
  struct alignas(64) Part {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };

  Call(std::size_t count, std::size_t members, Work what) : work(std::move(what)), parts(members), failures(count) {
    for (std::size_t k = 0; k < members; ++k) {
      parts[k].next = k * count / members;
      parts[k].end = (k + 1) * count / members;
    }
  }

  /// Do what is left; the calling thread is member 0.
  void take(std::size_t member) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      Part& part = parts[(member + k) % parts.size()];
      for (std::size_t i = part.next++; i < part.end; i = part.next++) {
        try {
          work(i);
        } catch (...) {
          failures[i] = std::current_exception();
          return;
        }
      }
    }
  }

  Work work;
  std::vector<Part> parts;
  std::vector<std::exception_ptr> failures;
};

/// The other threads and what they wait for.
struct Team::Others {
  const pid_t process = getpid();
  std::mutex mutex;
  std::condition_variable changed;
  Call* call = nullptr;
  std::atomic<std::uint64_t> calls{0};
  std::atomic<bool> ends{false};
  /// How many are in a call.
  std::atomic<int> busy{0};
  /// The last member, so that they end before what they use does.
  std::vector<std::jthread> threads;

  bool are_here() const { return process == getpid(); }

  void serve(std::size_t member) {
    std::uint64_t served = 0;
    while (true) {
      look([&] { return ends || calls != served; });
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return ends || (call && calls != served); });
      if (ends) return;
      served = calls;
      Call& taken = *call;
      ++busy;
      lock.unlock();
      taken.take(member);
      --busy;
      busy.notify_one();
    }
  }

  void set(Call* next) {
    const std::lock_guard lock(mutex);
    call = next;
    if (next) ++calls;
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

void Team::begin(std::size_t count, Work work) {
  finish();
  const std::size_t members = std::min(threads_, count);
  if (members > 1 && !others_) others_ = std::make_unique<Others>();
  if (members < 2 || !others_->are_here()) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  Others& it = *others_;
  while (it.threads.size() + 1 < members) {
    it.threads.emplace_back([&it, member = it.threads.size() + 1] { it.serve(member); });
  }
  call_ = std::make_unique<Call>(count, members, std::move(work));
  it.set(call_.get());
  it.changed.notify_all();
}

void Team::finish() {
  if (!call_) return;
  const auto call = std::move(call_);
  Others& it = *others_;
  call->take(0);
  it.set(nullptr);  // one that wakes up from now on is late, and nobody waits for it
  look([&] { return it.busy == 0; });
  for (int busy = it.busy; busy > 0; busy = it.busy) it.busy.wait(busy);
  for (const auto& failure : call->failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace mrpbench::sim
