#include "mrpbench_sim/walkers.hpp"

namespace mrpbench::sim {

namespace {

constexpr double kLambda = 2, kGamma = 0.35, kAngular = 2, kForward = 3;
constexpr double kLeast = 1e-9;

}  // namespace

Point social_force(const Walker& me, const Walker& other, double strength, double side) {
  const Point offset = other.place - me.place;
  const double distance = length(offset);
  if (distance < kLeast) return {};
  const Point towards = offset * (1 / distance);
  const Point interaction = (me.velocity - other.velocity) * kLambda + towards;
  const double size = length(interaction);
  if (size < kLeast) return {};
  const Point t = interaction * (1 / size), left{-t.y, t.x};
  const double range = kGamma * size;
  const double theta = std::atan2(t.x * towards.y - t.y * towards.x, dot(t, towards)) + side * range;
  const auto fall = [&](double n) { return std::exp(-distance / range - (n * range * theta) * (n * range * theta)); };
  const double sign = theta > 0 ? 1 : theta < 0 ? -1 : 0;
  return (t * -fall(kForward) - left * (sign * fall(kAngular))) * strength;
}

}  // namespace mrpbench::sim
