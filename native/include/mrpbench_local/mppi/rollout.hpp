// How MPPI samples: controls around a plan, velocities that follow them, and poses.
#pragma once

#include <span>

#include "mrpbench_local/mppi/noise.hpp"

namespace mrpbench::local::mppi {

/// What one step may change: `speed_up` and `slow_down` are positive, metres per second; `turn` in radians per second.
struct Change {
  float speed_up = 0, slow_down = 0, turn = 0;
};

/// What samples follow from: controls are `vx`, `wz` of each step plus noise of these standard deviations; velocities
/// begin at the start and follow the controls of the step before within `change`. Where the drive is late, they have
/// the velocities `sent_vx`, `sent_wz` of commands on their way in the next steps, and follow the controls after these,
/// from the start.
struct Sampling {
  const Noise& noise;
  float vx_std = 0, wz_std = 0;
  std::span<const float> vx, wz, sent_vx, sent_wz;
  float start_vx = 0, start_wz = 0;
  Change change;
  float dt = 0.05f;
};

/// Fill the tables. Poses begin at (0, 0, 0); row t is at the end of step t.
void roll_out(const Sampling& by, Tables& out);

}  // namespace mrpbench::local::mppi
