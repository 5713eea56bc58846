#include "mrpbench_amcl/fleet.hpp"

#include <algorithm>
#include <stdexcept>

#include "mrpbench_amcl/motion.hpp"

namespace mrpbench::amcl {

namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

bool finite(Pose pose) {
  return sim::somewhere({pose.x, pose.y}) && std::isfinite(pose.yaw);
}

const Parameters& sound(const Parameters& p, double resolution) {
  require(resolution > 0 && std::isfinite(resolution), "the resolution must be positive");
  require(p.min_particles >= 1 && p.max_particles >= p.min_particles, "max_particles must not be below min_particles");
  require(p.max_beams >= 1 && p.resample_interval >= 1, "max_beams and resample_interval must be positive");
  require(p.sigma_hit > 0 && p.laser_likelihood_max_dist > 0 && p.pf_err > 0, "deviations must be positive");
  for (const double it : {p.alpha1, p.alpha2, p.alpha3, p.alpha4, p.z_hit, p.z_rand, p.recovery_alpha_slow,
                          p.recovery_alpha_fast, p.initial_cov_xx, p.initial_cov_yy, p.initial_cov_aa}) {
    require(it >= 0 && std::isfinite(it), "parameters must not be negative");
  }
  return p;
}

/// Scale the weights so that their sum is one; if all are zero, make them equal.
void normalise(std::span<Particle> particles) {
  double sum = 0;
  for (const Particle& it : particles) sum += it.weight;
  for (Particle& it : particles) it.weight = sum > 0 ? it.weight / sum : 1 / static_cast<double>(particles.size());
}

/// Particles around a placement.
std::vector<Particle> around(Pose placement, const Parameters& parameters, sim::Draws draws) {
  std::vector<Particle> particles;
  for (int i = 0; i < parameters.max_particles; ++i) {
    const auto [x, y] = draws.normal();
    const auto [turn, unused] = draws.normal();
    const Pose pose{placement.x + std::sqrt(parameters.initial_cov_xx) * x,
                    placement.y + std::sqrt(parameters.initial_cov_yy) * y,
                    wrapped(placement.yaw + std::sqrt(parameters.initial_cov_aa) * turn)};
    particles.push_back({pose, 1.0 / parameters.max_particles});
  }
  return particles;
}

}  // namespace

Fleet::Fleet(const std::vector<sim::Segment>& segments, double resolution, Places places, std::vector<Pose> placements,
             const Parameters& parameters, std::uint64_t seed)
    : parameters_(sound(parameters, resolution)),
      field_(segments, resolution, parameters_),
      places_(std::move(places)),
      seed_(seed),
      filters_(placements.size()) {
  for (std::size_t robot = 0; robot < placements.size(); ++robot) {
    require(finite(placements[robot]), "placements must be finite");
    filters_[robot].estimate.pose = placements[robot];
    filters_[robot].particles = around(placements[robot], parameters_, sim::Draws(seed_, robot, 0));
  }
}

void Fleet::begin(std::span<const Pose> odometry) {
  check(odometry);
  for (std::size_t robot = 0; robot < filters_.size(); ++robot) filters_[robot].odometry = odometry[robot];
}

void Fleet::sense(const Scans& scans, std::span<const Pose> odometry) {
  check(odometry);
  require(scans.range > 0 && std::isfinite(scans.range), "the range must be positive");
  const std::size_t beams = scans.robots.empty() ? 0 : scans.ranges.size() / scans.robots.size();
  for (std::size_t row = 0; row < scans.robots.size(); ++row) {
    const int robot = scans.robots[row];
    require(robot >= 0 && static_cast<std::size_t>(robot) < filters_.size(), "there is no such robot");
    const auto index = static_cast<std::size_t>(robot);
    const Pose here = odometry[index];
    Filter& filter = filters_[index];
    const Pose step = relative(filter.odometry, here);
    const bool moved =
        std::hypot(step.x, step.y) > parameters_.update_min_d || std::abs(step.yaw) > parameters_.update_min_a;
    if (filter.scanned && !moved) continue;
    filter.scanned = true;
    const auto ranges = scans.ranges.subspan(row * beams, beams);
    update(filter, index, here, ends_of(ranges, scans.range, scans.min_range, scans.mount, parameters_));
  }
}

void Fleet::check(std::span<const Pose> odometry) const {
  require(odometry.size() == filters_.size(), "one odometry pose for each robot");
  require(std::all_of(odometry.begin(), odometry.end(), finite), "odometry must be finite");
}

void Fleet::update(Filter& filter, std::size_t robot, Pose odometry, const Ends& ends) const {
  sim::Draws draws(seed_, robot, ++filter.updates);
  move(filter.particles, relative(filter.odometry, odometry), parameters_, draws);
  const double total = field_.weigh(filter.particles, ends);
  normalise(filter.particles);
  // Long and short averages of the likelihoods of scans: if the short one is lower, the robot may be lost.
  const bool first = filter.slow == 0;
  filter.slow = first ? total : filter.slow + parameters_.recovery_alpha_slow * (total - filter.slow);
  filter.fast = first ? total : filter.fast + parameters_.recovery_alpha_fast * (total - filter.fast);
  if (filter.updates % static_cast<std::uint64_t>(parameters_.resample_interval) == 0) {
    const double random = filter.slow > 0 ? std::max(0.0, 1 - filter.fast / filter.slow) : 0.0;
    filter.particles = resampled(filter.particles, parameters_, random, places_, draws);
    if (random > 0) filter.slow = filter.fast = 0;
  }
  filter.estimate = amcl::estimate(filter.particles);
  filter.odometry = odometry;
}

Pose Fleet::pose(std::size_t robot, Pose odometry) const {
  const Filter& filter = filters_[robot];
  return composed(filter.estimate.pose, relative(filter.odometry, odometry));
}

}  // namespace mrpbench::amcl
