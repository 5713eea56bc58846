// Draws a number of particles that depends on their spread: D. Fox, "Adapting the sample size in particle filters
// through KLD-sampling", International Journal of Robotics Research 22(12), 2003. Some may be placed anywhere, to
// recover from a wrong estimate: J. Gutmann and D. Fox, "An experimental comparison of localization methods continued",
// IROS 2002.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_amcl/parameters.hpp"
#include "mrpbench_amcl/particle.hpp"
#include "mrpbench_sim/noise.hpp"

namespace mrpbench::amcl {

/// The number of particles that keeps the error below `pf_err` if they fill `bins` of the histogram.
int particles_for(std::size_t bins, const Parameters& parameters);

/// The places at which a robot can be: centres of free squares.
struct Places {
  std::vector<Point> centres;
  double width = 0;
};

/// Particles drawn by weight, all of equal weight afterwards. A share `random` of them is drawn from `places` instead.
std::vector<Particle> resampled(std::span<const Particle> particles, const Parameters& parameters, double random,
                                const Places& places, sim::Draws& draws);

}  // namespace mrpbench::amcl
