// PIBT with turns.
#pragma once

#include "mrpbench_discrete/planner.hpp"

namespace mrpbench::discrete {

/// Priority inheritance with backtracking (Okumura et al., Artificial Intelligence 310, 2022) over cells. A robot turns
/// towards the cell that it was given, keeps that intention until it has entered the cell, and moves when the robots in
/// front of it do.
class Pibt final : public Planner {
 public:
  explicit Pibt(std::uint64_t seed) : seed_(seed) {}
  void plan(const View& view, const Budget& budget, std::vector<Action>& action) override;

 private:
  void begin(const View& view);
  bool push(const View& view, int robot, int pusher);
  bool moves(const View& view, int robot, std::vector<Action>& action);

  std::uint64_t seed_;
  std::vector<double> priority_;
  std::vector<std::int32_t> intent_, wanted_, holder_, taker_, order_;
  std::vector<std::int32_t> last_goal_;
  std::vector<std::uint8_t> settled_;
};

}  // namespace mrpbench::discrete
