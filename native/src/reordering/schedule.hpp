// The earliest times of all events under the decisions made so far, which can be taken back in reverse order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "reordering/earliest.hpp"

namespace mrpbench::mapf {

/// The time that a robot reaches its goal, at the earliest.
struct Arrival {
  std::int32_t robot;
  Tick time;
};

class Schedule {
 public:
  /// A state to return to.
  struct Mark {
    std::size_t changes, made;
  };

  Schedule(const AlternativeGraph& graph, const Decisions& decisions, const ArcIndex& arcs, Limits& limits);

  /// False if even the fixed arcs form a cycle.
  bool consistent() const { return times_.consistent(); }
  /// Sum of the arrivals at goals: a lower bound on what any decisions to come can reach.
  Cost cost() const { return times_.cost(); }
  Tick arrival(int robot) const { return times_.arrival(robot); }
  bool is_open(int decision) const { return side_[decision] == kOpen; }
  /// Whether all arcs of a choice hold at the present times.
  bool holds(Choice choice) const { return violations_[choice.index()] == 0; }
  /// Open decisions of which neither choice holds.
  std::span<const std::int32_t> pending() const { return pending_; }
  bool is_pending(int decision) const { return position_[decision] >= 0; }
  /// Time from which the robots of a decision can conflict.
  Tick begins(int decision) const;
  /// Sum of the times at both ends of the arcs of a choice: it changes whenever one of them does, as times only grow.
  std::int64_t times_around(Choice choice) const;
  /// The work done, see `EarliestTimes`.
  std::int64_t work() const { return times_.work(); }

  Mark mark() const { return {times_.changes(), made_.size()}; }
  /// Make a choice and all choices it implies. False if it forms a cycle; `undo` must then follow.
  bool decide(Choice choice);
  void undo(const Mark& mark);
  /// The robots that would arrive later with a choice, sorted; nothing if it forms a cycle.
  std::optional<std::vector<Arrival>> probe(Choice choice);

 private:
  static constexpr std::int8_t kOpen = -1;

  bool make(Choice choice);
  void take_back(const Mark& mark);
  void update_violations(std::int32_t event);
  void update_violation(std::int32_t arc);
  void update_pending(std::int32_t decision);

  const Decisions& decisions_;
  const ArcIndex& arcs_;
  EarliestTimes times_;
  std::vector<char> violated_;                    // by arc
  std::vector<std::int32_t> violations_;          // number of violated arcs, by index of choice
  std::vector<std::int8_t> side_;                 // by decision
  std::vector<std::int32_t> pending_, position_;  // position_: index in pending_, -1 = absent
  std::vector<Choice> made_;
};

}  // namespace mrpbench::mapf
