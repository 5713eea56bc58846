// One pose from many particles: the mean of the heaviest cluster, as in Nav2.
#pragma once

#include <array>
#include <span>

#include "mrpbench_amcl/particle.hpp"

namespace mrpbench::amcl {

struct Estimate {
  Pose pose;
  /// Of x, y, yaw, row by row.
  std::array<double, 9> covariance{};
};

/// A cluster is the set of particles in bins of the histogram that touch one another.
Estimate estimate(std::span<const Particle> particles);

}  // namespace mrpbench::amcl
