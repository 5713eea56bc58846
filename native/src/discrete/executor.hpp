// The executor of 2026: keeps the order in which the plan lets robots enter cells, whatever the delays.
#pragma once

#include <deque>
#include <vector>

#include "mrpbench_discrete/grid.hpp"
#include "squares.hpp"

namespace mrpbench::discrete {

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
  std::vector<std::deque<std::int32_t>> queue_;
  std::vector<std::uint8_t> go_, known_;
};

}  // namespace mrpbench::discrete
