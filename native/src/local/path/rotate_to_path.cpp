#include "mrpbench_local/path/rotate_to_path.hpp"

#include <algorithm>
#include <cmath>

#include "mrpbench_local/costmap/collision.hpp"

namespace mrpbench::local {

namespace {

/// Distance along a path, in metres, at which its direction is measured.
constexpr double kAhead = 0.3;

/// Angle in radians between the heading of a robot and its path.
double off(Pose pose, const Path& path) {
  Point at = path.first;
  double left = kAhead;
  for (const Point& next : path.rest) {
    const double length = sim::length(next - at);
    if (length >= left) {
      at = at + (next - at) * (left / length);
      break;
    }
    left -= length;
    at = next;
  }
  const Point away = at - Point{pose.x, pose.y};
  if (sim::length(away) < kAhead / 3) return 0;  // a robot that has nearly arrived need not turn
  return wrapped(std::atan2(away.y, away.x) - pose.yaw);
}

}  // namespace

void RotateToPath::begin(Pose pose, const Path& path) {
  turning_ = threshold_ > 0 && std::abs(off(pose, path)) > threshold_;
}

std::optional<Twist> RotateToPath::command(Pose pose, const Path& path, const Costmap& costmap) {
  if (!turning_) return std::nullopt;
  const double left = off(pose, path);
  turning_ = std::abs(left) > threshold_ / 4 && is_free(costmap, {pose.x, pose.y, pose.yaw + left}, false);
  if (!turning_) return std::nullopt;
  const double rate = std::min(limits_.rate, std::sqrt(limits_.acceleration * std::abs(left)));
  return Twist{0, std::copysign(rate, left)};
}

}  // namespace mrpbench::local
