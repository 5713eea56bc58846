// The motion of particles with odometry: the odometry motion model of S. Thrun, W. Burgard and D. Fox, "Probabilistic
// Robotics", MIT Press 2005, section 5.4: a rotation, a translation and a second rotation, each with its error.
#pragma once

#include <span>

#include "mrpbench_amcl/parameters.hpp"
#include "mrpbench_amcl/particle.hpp"
#include "mrpbench_sim/noise.hpp"

namespace mrpbench::amcl {

/// Move particles by `step`, which odometry measured in the robot's frame before it.
void move(std::span<Particle> particles, Pose step, const Parameters& parameters, sim::Draws& draws);

}  // namespace mrpbench::amcl
