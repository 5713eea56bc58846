// How moving objects are found in scans, followed and predicted.
#pragma once

#include "mrpbench_options/options.hpp"

namespace mrpbench::tracking {

struct Options {
  double horizon = 3, radius = 0.3, largest_object = 0.8;
  double wall_distance = 0.15, robot_distance = 0.1, segment_gap = 0.15;
  double gating_distance = 0.7, lost_after = 1, least_speed = 0.3;
  double measurement_deviation = 0.1, acceleration_deviation = 1;
  int confirmed_after = 3;

  static Description<Options> description();
};

}  // namespace mrpbench::tracking
