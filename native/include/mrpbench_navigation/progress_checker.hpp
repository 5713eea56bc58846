// Whether robots make progress: to Nav2's `SimpleProgressChecker` turning on the spot is no progress, to its
// `PoseProgressChecker` it is.
#pragma once

#include <limits>
#include <vector>

#include "mrpbench_navigation/routes.hpp"

namespace mrpbench::navigation {

/// Parameters of Nav2's checkers, by their names.
struct ProgressRules {
  double required_movement_radius = 0.5;  // metres
  double movement_time_allowance = 10;    // simulated seconds within which a robot has to make progress
  double required_movement_angle = std::numeric_limits<double>::infinity();  // inf = turning is no progress
};

class ProgressChecker {
 public:
  ProgressChecker(std::size_t robots, const ProgressRules& rules);

  /// Begin the control period `now`, in simulated seconds.
  void begin(double now);

  /// Tell whether a robot that is `under_way` is stuck; its time then begins anew. Where `speed` in m/s is so low that
  /// it needs more than half of the time allowed to move far enough, its time passes more slowly.
  bool is_stuck(std::size_t robot, const Pose& pose, bool under_way, double speed);

 private:
  struct Robot {
    Pose place{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0};
    double since = 0;  // the simulated second of its last progress, at `place`
    Pose before;       // where it was in the last control period
    bool was_under_way = true;
  };

  ProgressRules rules_;
  double slow_, now_ = 0, before_ = 0;
  std::vector<Robot> robots_;
};

}  // namespace mrpbench::navigation
