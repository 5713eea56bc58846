// One tick of squares on a grid (2026): who moves, who is refused.
#pragma once

#include <cstdint>
#include <vector>

#include "mrpbench_discrete/grid.hpp"

namespace mrpbench::discrete {

/// Robots between cells. What a robot has begun it must finish.
struct Bodies {
  std::vector<Pose> pose;
  /// The action begun and the ticks of progress made in it, below `counter`.
  std::vector<Action> begun;
  std::vector<std::int32_t> progress;
};

/// Squares of side `size`, anchored in the corner of their cells. A robot in a forward action is `progress / counter`
/// ahead of its cell; a tick carries it `1 / counter` further along a straight line. Squares may touch.
class Squares {
 public:
  Squares(const Grid& grid, double size, int counter);

  /// Advance those of `acts` by one tick of their action `begun`. Returns who really advanced: not those that would
  /// drive into a wall or another robot, nor a cycle of robots each of which needs the next to go first.
  const std::vector<std::uint8_t>& advance(Bodies& bodies, const std::vector<std::uint8_t>& acts);

 private:
  bool decide(const Bodies& bodies, int robot);
  bool clash(const Bodies& bodies, int robot, int other, bool other_moves) const;

  const Grid& grid_;
  const double size_;
  const int counter_;
  std::vector<std::int32_t> owner_;
  std::vector<std::uint8_t> wants_, state_;
};

}  // namespace mrpbench::discrete
