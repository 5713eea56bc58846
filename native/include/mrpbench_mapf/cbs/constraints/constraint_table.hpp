// The constraints that bind one robot in one node of the constraint tree, listed by vertex: what a search asks of them
// costs one look-up where nothing is constrained.
#pragma once

#include "mrpbench_mapf/cbs/constraints/timed_path.hpp"

namespace mrpbench::mapf {

class ConstraintTable {
 public:
  ConstraintTable(const Space& space, Limits& limits);

  /// Start over for `robot`, which goes to `goal`, with no constraints but the committed segments of the others.
  void reset(int robot, int goal = TimedPath::kAnyGoal);
  /// A constraint of this robot, or a `length_at_most` of another one; others are ignored.
  void add(const Constraint& constraint);
  void add(std::span<const Constraint> constraints) {
    for (const Constraint& constraint : constraints) add(constraint);
  }

  int robot() const { return robot_; }
  int goal() const { return goal_; }
  /// Tell whether any of the next three functions can be true for `vertex`.
  bool constrains(int vertex) const { return head_[vertex] >= 0; }
  /// Tell whether the robot must not be at `vertex` at tick `at`.
  bool forbids(int vertex, Tick at) const { return head_[vertex] >= 0 && blocked(vertex, kVertex, 2 * at, 2 * at); }
  /// Tell whether it must not stand at `vertex` from tick `at` to the next tick (included).
  bool forbids_waiting(int vertex, Tick at) const {
    return head_[vertex] >= 0 && blocked(vertex, kVertex, 2 * at + 1, 2 * at + 2);
  }
  /// Tell whether it must not enter `edge`, which leads out of `vertex`, at tick `at`.
  bool forbids_entering(int vertex, int edge, Tick at) const {
    return head_[vertex] >= 0 && blocked(vertex, edge, at, at);
  }
  /// Append the half-ticks at which it must not be at `vertex`.
  void at_vertex(int vertex, std::vector<Range>& halves) const;
  /// The first tick from `at` on at which it may enter `edge`, which leads out of `vertex`.
  Tick next_entry(int vertex, int edge, Tick at) const;
  /// Tell whether a commitment of the robot is forbidden.
  bool forbids_beginning() const;

  /// Tick from which nothing changes any more.
  Tick settled() const { return settled_; }
  /// First tick at which the robot's last move may end at `vertex`, kForever if never.
  Tick earliest_finish(int vertex) const;
  /// The same for its goal, or for the best of them.
  Tick earliest_finish() const;
  Tick latest_finish() const { return latest_finish_; }

 private:
  static constexpr std::int32_t kVertex = -1, kFinish = -2;
  struct Entry {
    std::int32_t edge;  // of the roadmap, kVertex, or kFinish: the last move must not end there at the ticks `range`
    Range range;
    std::int32_t next;
  };
  bool blocked(int vertex, int edge, std::int32_t first, std::int32_t last) const {
    for (std::int32_t k = head_[vertex]; k >= 0; k = entries_[k].next) {
      const Entry& entry = entries_[k];
      if (entry.edge == edge && entry.range.first <= last && entry.range.last >= first) return true;
    }
    return false;
  }
  void forbid(int element, Range range);
  void forbid_finishing(int vertex, Tick until);
  void enter(int vertex, const Entry& entry);
  void make_way(const Constraint& parked);
  void forbid_resource(int resource, Range halves);
  void forbid_junction(int junction, Range halves);
  void keep_away(int element, Range halves);

  const Space& space_;
  Limits& limits_;
  int robot_ = -1;
  int goal_ = TimedPath::kAnyGoal;
  Tick settled_ = 0;
  int finish_at_ = TimedPath::kAnyGoal;  // the only place
  Tick latest_finish_ = kForever;
  bool forbids_beginning_ = false;
  std::vector<std::int32_t> head_;  // by vertex, -1 = none
  std::vector<std::int32_t> touched_;
  std::vector<Entry> entries_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
