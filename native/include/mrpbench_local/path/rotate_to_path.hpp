// Turns a robot on the spot where a new path leads off its heading, as the rotation shim of Nav2 does: controllers that
// drive while they turn would leave the path, or not come away.
#pragma once

#include <optional>

#include "mrpbench_local/costmap/costmap.hpp"
#include "mrpbench_local/path/path.hpp"

namespace mrpbench::local {

class RotateToPath {
 public:
  /// What turns may do: rad/s and rad/s^2.
  struct Limits {
    double rate = 0, acceleration = 0;
  };

  /// `threshold`: the angle in radians above which a robot turns first; 0 = never.
  RotateToPath(double threshold, Limits limits) : threshold_(threshold), limits_(limits) {}

  /// A new path: decide whether to turn.
  void begin(Pose pose, const Path& path);
  /// The command of a robot that turns, or nothing.
  std::optional<Twist> command(Pose pose, const Path& path, const Costmap& costmap);

 private:
  double threshold_;
  Limits limits_;
  bool turning_ = false;
};

}  // namespace mrpbench::local
