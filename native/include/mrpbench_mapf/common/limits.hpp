// A deadline and a memory limit that every loop of a solver checks.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <new>

namespace mrpbench::mapf {

/// How a solver ended.
enum class Status { solved, timeout, out_of_memory, unsolvable, gave_up };

/// Thrown by `Limits`, caught by `solve_within`.
struct LimitReached {
  Status status;
};

class Limits {
 public:
  /// The clock starts now. `memory_bytes` bounds what the solver itself counts.
  Limits(double wall_s, std::int64_t memory_bytes)
      : begin_(Clock::now()), memory_limit_(memory_bytes), memory_left_(memory_bytes) {
    using Duration = std::chrono::duration<double>;
    limited_ = wall_s < 1e9;
    if (limited_) end_ = begin_ + std::chrono::duration_cast<Clock::duration>(Duration(wall_s > 0 ? wall_s : 0));
  }

  /// Wall seconds since the clock started.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  /// Call this once per step of a loop with steps of microseconds; it reads the clock every 64th time.
  void check() {
    if ((++calls_ & 63) == 0) check_clock();
  }
  void check_clock() const {
    if (limited_ && Clock::now() >= end_) throw LimitReached{Status::timeout};
  }
  /// Count memory that lives until the solver ends.
  void charge(std::size_t bytes) {
    memory_left_ -= static_cast<std::int64_t>(bytes);
    if (memory_left_ < 0) throw LimitReached{Status::out_of_memory};
  }
  /// Bytes that may still be counted, and that were counted.
  std::int64_t memory_left() const { return memory_left_; }
  std::int64_t memory_used() const { return memory_limit_ - memory_left_; }
  /// Count how far a growing container exceeds what was counted for it before.
  void charge_growth(std::size_t& counted, std::size_t bytes) {
    if (bytes <= counted) return;
    const std::size_t growth = bytes - counted;
    counted = bytes;
    charge(growth);
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_;
  bool limited_;
  Clock::time_point end_;
  std::int64_t memory_limit_, memory_left_;
  std::uint32_t calls_ = 0;
};

}  // namespace mrpbench::mapf
