// What one robot must not do on a roadmap of unit moves, listed by the vertex where it would arrive.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "mrpbench_mapf/limits.hpp"

namespace mrpbench::mapf {

class UnitConstraints {
 public:
  UnitConstraints(int vertex_count, Limits& limits) {
    limits.charge(static_cast<std::size_t>(vertex_count) * sizeof(std::int32_t));
    head_.assign(vertex_count, -1);
  }

  void reset() {
    for (const std::int32_t vertex : touched_) head_[vertex] = -1;
    touched_.clear();
    entries_.clear();
    closed_.clear();
    earliest_ = last_ = 0;
    latest_ = kForever;
  }
  /// Do not be at `vertex` at any of these ticks; the last may be kForever.
  void forbid_vertex(int vertex, Range ticks) {
    add(vertex, {ticks, kAnywhere, -1});
    if (ticks.last == kForever) closed_.push_back(vertex);
  }
  /// Do not arrive at `to` from `from` at any of these ticks.
  void forbid_move(int from, int to, Range ticks) { add(to, {ticks, from, -1}); }
  /// Arrive for good at one of these ticks.
  void limit_arrival(Range ticks) {
    earliest_ = std::max(earliest_, ticks.first);
    latest_ = std::min(latest_, ticks.last);
    last_ = std::max(last_, earliest_);
  }

  bool forbids(int from, int to, Tick arrival) const {
    for (std::int32_t k = head_[to]; k >= 0; k = entries_[k].next) {
      const Entry& entry = entries_[k];
      if (arrival < entry.ticks.first || arrival > entry.ticks.last) continue;
      if (entry.from == kAnywhere || entry.from == from) return true;
    }
    return false;
  }
  /// The first tick from which a robot may stay at `goal` for good, kForever if there is none.
  Tick free_from(int goal) const {
    Tick free = earliest_;
    for (std::int32_t k = head_[goal]; k >= 0; k = entries_[k].next) {
      if (entries_[k].from == kAnywhere) free = std::max(free, std::min(entries_[k].ticks.last, kForever - 1) + 1);
    }
    return free;
  }
  Tick latest_arrival() const { return latest_; }
  /// Vertices that are forbidden for ever, from some tick on.
  std::span<const std::int32_t> closed() const { return closed_; }
  /// After this tick nothing changes any more.
  Tick last_change() const { return last_; }

 private:
  static constexpr std::int32_t kAnywhere = -1;
  struct Entry {
    Range ticks;
    std::int32_t from;
    std::int32_t next;
  };

  void add(int vertex, Entry entry) {
    if (head_[vertex] < 0) touched_.push_back(vertex);
    entry.next = head_[vertex];
    head_[vertex] = static_cast<std::int32_t>(entries_.size());
    entries_.push_back(entry);
    last_ = std::max(last_, entry.ticks.last == kForever ? entry.ticks.first : entry.ticks.last);
  }

  std::vector<std::int32_t> head_;  // by vertex, -1 = none
  std::vector<std::int32_t> touched_;
  std::vector<Entry> entries_;
  std::vector<std::int32_t> closed_;
  Tick earliest_ = 0, latest_ = kForever, last_ = 0;
};

}  // namespace mrpbench::mapf
