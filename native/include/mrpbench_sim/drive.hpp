// A differential drive: how its speeds follow commands, and how slip of its wheels changes them.
#pragma once

#include <algorithm>
#include <cmath>

namespace mrpbench::sim {

/// Metres per second ahead, radians per second counter-clockwise.
struct Twist {
  double ahead = 0, turn = 0;
};

struct Drive {
  Twist limit, acceleration;
  double wheel_separation = 0;
};

/// Shares of their travel that the wheels lose.
struct Slip {
  double left = 0, right = 0;
};

inline Twist limited(const Drive& drive, Twist command) {
  return {std::clamp(command.ahead, -drive.limit.ahead, drive.limit.ahead),
          std::clamp(command.turn, -drive.limit.turn, drive.limit.turn)};
}

/// Mean over `dt` of a speed that changes at full acceleration until `wanted` is reached, and then stays; `speed`
/// becomes the speed at the end.
inline double accelerate(double& speed, double wanted, double acceleration, double dt) {
  const double change = std::clamp(wanted - speed, -acceleration * dt, acceleration * dt);
  const double lag = change == 0 ? 0.0 : change * std::abs(change) / (2 * acceleration * dt);
  const double mean = speed + change - lag;
  speed += change;
  return mean;
}

/// The twist over ground with slip.
inline Twist slipped(const Drive& drive, Twist twist, Slip slip) {
  if (slip.left == 0 && slip.right == 0) return twist;
  const double half = drive.wheel_separation / 2;
  const double left = (twist.ahead - twist.turn * half) * (1 - slip.left);
  const double right = (twist.ahead + twist.turn * half) * (1 - slip.right);
  return {(left + right) / 2, (right - left) / drive.wheel_separation};
}

}  // namespace mrpbench::sim
