// Poses in frames of the plane; radians.
#pragma once

#include <cmath>
#include <numbers>

#include "mrpbench_sim/plane.hpp"

namespace mrpbench::sim {

/// The same angle within [-pi, pi).
inline double wrapped(double angle) {
  return angle - 2 * std::numbers::pi * std::floor((angle + std::numbers::pi) / (2 * std::numbers::pi));
}

/// `pose`, given in `frame`, in the parent frame of `frame`.
inline Pose composed(Pose frame, Pose pose) {
  const double c = std::cos(frame.yaw), s = std::sin(frame.yaw);
  return {frame.x + c * pose.x - s * pose.y, frame.y + s * pose.x + c * pose.y, wrapped(frame.yaw + pose.yaw)};
}

/// The inverse of `composed`.
inline Pose relative(Pose frame, Pose pose) {
  const double c = std::cos(frame.yaw), s = std::sin(frame.yaw), x = pose.x - frame.x, y = pose.y - frame.y;
  return {c * x + s * y, c * y - s * x, wrapped(pose.yaw - frame.yaw)};
}

}  // namespace mrpbench::sim
