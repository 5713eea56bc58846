// The executor of 2026: keeps the order in which the plan lets robots enter cells, whatever the delays.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "mrpbench_discrete/grid.hpp"
#include "squares.hpp"

namespace mrpbench::discrete {

/// A queue of robots for each cell. Empty ones take no memory but for two numbers.
class CellQueues {
 public:
  explicit CellQueues(int cells) : ends_(cells, {-1, -1}) {}

  void push(int cell, std::int32_t robot);
  void pop(int cell);
  std::int32_t first(int cell) const { return links_[ends_[cell][0]].robot; }
  /// -1 = none.
  std::int32_t second(int cell) const {
    const std::int32_t next = links_[ends_[cell][0]].next;
    return next < 0 ? -1 : links_[next].robot;
  }

 private:
  struct Link {
    std::int32_t robot, next;
  };
  std::vector<std::array<std::int32_t, 2>> ends_;
  std::vector<Link> links_;
  std::vector<std::int32_t> unused_;
};

/// A dependency graph by cells (Hönig et al., IEEE RA-L 2019): each cell has a queue of the robots that are to enter
/// it, the robot in it first. A robot may go if it is next, or if it follows, straight on, the robot that is leaving.
/// Waits of the plan are not kept.
class Executor {
 public:
  Executor(const Grid& grid, const std::vector<Pose>& start);

  /// Append one step of a plan.
  void stage(const std::vector<Action>& action);
  /// Where robots are after all that is staged.
  const std::vector<Pose>& last() const { return last_; }
  const std::deque<Action>& staged(int robot) const { return staged_[robot]; }
  /// Who may go in this tick, knowing the delays of the tick before.
  const std::vector<std::uint8_t>& go(const Bodies& bodies, const std::vector<std::uint8_t>& delayed_before);
  /// A robot has finished its first staged action; it began at `from`.
  void finish(int robot, const Pose& from);

 private:
  bool ready(const Bodies& bodies, const std::vector<std::uint8_t>& delayed, int robot);

  const Grid& grid_;
  std::vector<Pose> last_;
  std::vector<std::deque<Action>> staged_;
  CellQueues queue_;
  std::vector<std::uint8_t> go_, known_;
};

}  // namespace mrpbench::discrete
