// The earliest times of all events under the arcs that hold, which follow when arcs are added or removed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "reordering/arc_index.hpp"

namespace mrpbench::mapf {

class EarliestTimes {
 public:
  struct Change {
    std::int32_t event;
    Tick before;
  };

  /// `holds` tells by arc which ones hold.
  EarliestTimes(const AlternativeGraph& graph, const ArcIndex& arcs, std::vector<char> holds, Limits& limits);

  /// False if the arcs form a cycle; then there are no times.
  bool consistent() const { return consistent_; }
  /// Sum of the arrivals at goals.
  Cost cost() const { return cost_; }
  Tick operator[](std::int32_t event) const { return time_[event]; }
  Tick arrival(int robot) const { return time_[graph_.first[robot + 1] - 1]; }
  /// When its robot would be there if it waited for nobody after the event before.
  Tick without_waiting(std::int32_t event) const {
    return is_first_[event] ? 0 : time_[event - 1] + graph_.duration[event - 1];
  }
  /// Robot whose last event this is, -1 for other events.
  std::int32_t robot_at_goal(std::int32_t event) const { return goal_of_[event]; }
  /// Number of times computed so far: the work done, whatever the clock says.
  std::int64_t work() const { return work_; }

  /// Let an arc hold from now on. False if it closes a cycle; `undo` must then follow.
  bool add(std::int32_t arc);
  /// Let the arcs of a choice hold no longer.
  void remove(Choice choice);

  /// What has changed since as many changes were made; the same event may be there several times.
  std::span<const Change> since(std::size_t count) const { return std::span(changes_).subspan(count); }
  std::size_t changes() const { return changes_.size(); }
  /// Return to the times after so many changes. Which arcs hold is up to the caller, see `hold`.
  void undo(std::size_t count);
  /// Tell whether the arcs of a choice hold, where `undo` has taken care of the times.
  void hold(Choice choice, bool now);
  /// Keep the changes for good.
  void keep() { changes_.clear(); }

 private:
  struct Waiting {
    Tick key;
    std::int32_t event;
    bool operator>(const Waiting& it) const { return key != it.key ? key > it.key : event > it.event; }
  };

  void raise(std::int32_t event, Tick time);
  void wait(std::int32_t event);
  std::int32_t next();
  void set(std::int32_t event, Tick time);
  Tick earliest(std::int32_t event) const;

  const AlternativeGraph& graph_;
  const ArcIndex& arcs_;
  Limits& limits_;
  std::vector<char> holds_;     // by arc
  std::vector<char> is_first_;  // by event
  std::vector<std::int32_t> goal_of_;
  std::vector<Tick> time_, next_time_;  // by event; next_time_: what an event in the heap gets at least, 0 = not there
  std::vector<Change> changes_;
  std::vector<Waiting> heap_;
  Cost cost_ = 0;
  std::int64_t work_ = 0;
  bool consistent_;
};

}  // namespace mrpbench::mapf
