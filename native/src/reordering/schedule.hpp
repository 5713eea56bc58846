// The earliest times of all events under the decisions made so far, which can be taken back in reverse order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "reordering/decisions.hpp"

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

  Schedule(const AlternativeGraph& graph, const Decisions& decisions, Limits& limits);

  /// False if even the fixed arcs form a cycle.
  bool consistent() const { return consistent_; }
  /// Sum of the arrivals at goals: a lower bound on what any decisions to come can reach.
  Cost cost() const { return cost_; }
  Tick arrival(int robot) const { return time_[last_[robot]]; }
  bool is_open(int decision) const { return side_[decision] == kOpen; }
  /// Whether all arcs of a choice hold at the present times.
  bool holds(Choice choice) const { return violations_[index(choice)] == 0; }
  /// Open decisions of which neither choice holds.
  std::span<const std::int32_t> pending() const { return pending_; }
  bool is_pending(int decision) const { return position_[decision] >= 0; }
  /// Time from which the robots of a decision can conflict.
  Tick begins(int decision) const;
  /// Sum of the times at both ends of the arcs of a choice: it changes whenever one of them does, as times only grow.
  std::int64_t times_around(Choice choice) const;

  Mark mark() const { return {changes_.size(), made_.size()}; }
  /// Make a choice and all choices it implies. False if it forms a cycle; `undo` must then follow.
  bool decide(Choice choice);
  void undo(const Mark& mark);
  /// The robots that would arrive later with a choice, sorted; nothing if it forms a cycle.
  std::optional<std::vector<Arrival>> probe(Choice choice);

 private:
  static constexpr std::int8_t kOpen = -1;
  struct Change {
    std::int32_t event;
    Tick before;
  };
  struct Waiting {
    Tick key;
    std::int32_t event;
    bool operator>(const Waiting& it) const { return key != it.key ? key > it.key : event > it.event; }
  };

  static std::size_t index(Choice choice) { return 2 * static_cast<std::size_t>(choice.decision) + choice.side; }
  bool make(Choice choice);
  bool add(std::int32_t arc);
  void push(std::int32_t event, Tick time);
  void set(std::int32_t event, Tick time);
  void take_back(const Mark& mark);
  void update_violations(std::int32_t event);
  void update_violation(std::int32_t arc);
  void update_pending(std::int32_t decision);

  const AlternativeGraph& graph_;
  const Decisions& decisions_;
  Limits& limits_;
  std::vector<Arc> arcs_;                  // those of choices in the order of `index`, then the fixed ones
  std::vector<std::int32_t> arc_begin_;    // by index of choice
  std::vector<std::int32_t> decision_of_;  // by arc of a choice
  std::vector<std::int32_t> out_, out_begin_, in_, in_begin_;  // arcs by `before`, and by `after`
  std::vector<char> active_, violated_;                        // by arc
  std::vector<std::int32_t> violations_;                       // number of violated arcs, by index of choice
  std::vector<std::int32_t> last_, goal_of_;      // last event of each robot; robot of each last event, -1 for others
  std::vector<Tick> time_, next_time_;            // by event; next_time_: what an event in the heap gets, 0 = not there
  std::vector<std::int8_t> side_;                 // by decision
  std::vector<std::int32_t> pending_, position_;  // position_: index in pending_, -1 = absent
  std::vector<Change> changes_;
  std::vector<Choice> made_;
  std::vector<Waiting> heap_;
  Cost cost_ = 0;
  bool consistent_;
};

}  // namespace mrpbench::mapf
