#include "mrpbench_navigation/routes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrpbench::navigation {

namespace {

constexpr double slack = 1e-6;  // square metres

}  // namespace

bool Arrival::holds(double at_x, double at_y) const {
  const double dx = at_x - x, dy = at_y - y;
  if (beyond(dx, dy, tolerance) <= 0) return true;
  return dx * along_x + dy * along_y >= 0 && std::abs(along_x * dy - along_y * dx) <= lateral_tolerance;
}

bool Rounding::holds(double at_x, double at_y) const {
  return (at_x - x) * normal_x + (at_y - y) * normal_y >= -slack;
}

bool Clearing::holds(double at_x, double at_y) const {
  return beyond(at_x - x, at_y - y, distance) >= 0;
}

Point Leg::nearest(double at_x, double at_y) const {
  const double along = (at_x - x) * dx + (at_y - y) * dy;
  const double share = std::clamp(along / squared, 0.0, 1.0);
  return {x + share * dx, y + share * dy};
}

double modulo(double value, double by) {
  const double rest = std::fmod(value, by);
  if (rest == 0) return std::copysign(0.0, by);
  return (rest < 0) == (by < 0) ? rest : rest + by;
}

double angle_between(double yaw, double other) {
  return std::abs(modulo(yaw - other + std::numbers::pi, 2 * std::numbers::pi) - std::numbers::pi);
}

}  // namespace mrpbench::navigation
