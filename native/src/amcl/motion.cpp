#include "mrpbench_amcl/motion.hpp"

#include <algorithm>

namespace mrpbench::amcl {

namespace {

/// Metres; the direction of a shorter motion is not significant.
constexpr double kShort = 0.01;

/// The turn towards the direction of a motion, which may also be backwards.
double turned(double angle) {
  return std::min(std::abs(wrapped(angle)), std::abs(wrapped(angle - std::numbers::pi)));
}

}  // namespace

void move(std::span<Particle> particles, Pose step, const Parameters& parameters, sim::Draws& draws) {
  const double way = std::hypot(step.x, step.y);
  const double first = way < kShort ? 0.0 : std::atan2(step.y, step.x);
  const double second = wrapped(step.yaw - first);
  const double a = turned(first), b = turned(second);
  const double first_error = std::sqrt(parameters.alpha1 * a * a + parameters.alpha2 * way * way);
  const double way_error = std::sqrt(parameters.alpha3 * way * way + parameters.alpha4 * (a * a + b * b));
  const double second_error = std::sqrt(parameters.alpha1 * b * b + parameters.alpha2 * way * way);
  for (Particle& it : particles) {
    const auto [one, two] = draws.normal();
    const auto [three, unused] = draws.normal();
    const double heading = it.pose.yaw + first + first_error * one, ahead = way + way_error * two;
    it.pose.x += ahead * std::cos(heading);
    it.pose.y += ahead * std::sin(heading);
    it.pose.yaw = wrapped(heading + second + second_error * three);
  }
}

}  // namespace mrpbench::amcl
