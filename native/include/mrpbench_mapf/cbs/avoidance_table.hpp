// How many robots would be in the way of a step: the conflict avoidance table of Standley, "Finding optimal solutions
// to cooperative pathfinding problems", AAAI 2010. It only breaks ties, or guides a focal search.
#pragma once

#include <cstdint>

#include "mrpbench_mapf/cbs/space.hpp"
#include "mrpbench_mapf/cbs/timed_path.hpp"

namespace mrpbench::mapf {

class AvoidanceTable {
 public:
  AvoidanceTable(const Space& space, Limits& limits);

  void add(int robot, const TimedPath& path);
  void remove(int robot, const TimedPath& path);
  void clear();
  /// Call after changes, before questions.
  void refresh();

  /// Robots in the way of `robot`, whose own path must not be in the table, if it stands at `vertex` from tick `at` to
  /// the next, that one included.
  int waiting(int robot, int vertex, Tick at) const {
    if (!textbook_) return reservations_->count(robot, {vertex, 2 * at + 1, 2 * at + 2});
    return standing(vertex, at + 1);
  }
  /// ... if it makes `move` out of `vertex` at tick `at`, the arrival included. Textbook: `meets_at_vertex` says
  /// whether anybody is at `vertex` one tick later; without that nobody can swap with it.
  int moving(int robot, const Move& move, Tick at, bool meets_at_vertex) const {
    if (!textbook_) return moving_on_lanes(robot, move, at);
    return standing(move.head, at + 1) + (meets_at_vertex && move.against >= 0 ? crossing(move.against, at) : 0);
  }

 private:
  struct Slot {
    std::uint64_t key = kFree;
    std::int32_t count = 0;
  };
  struct Parked {
    Tick from;
    std::int32_t next;  // robot at the same vertex, -1 = none
  };
  static constexpr std::uint64_t kFree = ~0ULL;
  static std::uint64_t key(int element, Tick at) {
    return static_cast<std::uint64_t>(element) << 32 | static_cast<std::uint32_t>(at);
  }
  std::size_t place(std::uint64_t key) const {
    std::size_t slot = (key * 0x9E3779B97F4A7C15ULL) >> shift_;
    while (slots_[slot].key != key && slots_[slot].key != kFree) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  int standing(int vertex, Tick at) const { return slots_[place(key(vertex, at))].count + parked(vertex, at); }
  int crossing(int edge, Tick at) const { return slots_[place(key(vertices_ + edge, at))].count; }
  int parked(int vertex, Tick at) const;
  int moving_on_lanes(int robot, const Move& move, Tick at) const;
  void change(int robot, const TimedPath& path, int by);
  void change(std::uint64_t key, int by);
  void rehash();

  const Space& space_;
  Limits& limits_;
  bool textbook_;
  int vertices_;
  std::vector<Slot> slots_;  // open addressing; a count of 0 stays until the table is made anew
  int shift_;
  std::size_t used_ = 0;
  std::vector<std::int32_t> parked_head_;  // by vertex: a robot that stays there, -1 = none
  std::vector<Parked> parked_;             // by robot
  // what takes its place where the textbook's rules do not suffice
  std::optional<Reservations> reservations_;
  std::vector<TimedPath> paths_;  // by robot
  bool stale_ = false;
};

}  // namespace mrpbench::mapf
