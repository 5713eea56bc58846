#include "mrpbench_amcl/resampling.hpp"

#include <algorithm>
#include <unordered_set>

namespace mrpbench::amcl {

namespace {

Pose anywhere(const Places& places, sim::Draws& draws) {
  const auto count = static_cast<double>(places.centres.size());
  const Point centre = places.centres[static_cast<std::size_t>(draws.uniform() * count)];
  const double x = draws.uniform() - 0.5, y = draws.uniform() - 0.5;
  return {centre.x + x * places.width, centre.y + y * places.width, (2 * draws.uniform() - 1) * std::numbers::pi};
}

}  // namespace

int particles_for(std::size_t bins, const Parameters& parameters) {
  if (bins <= 1) return parameters.min_particles;
  const double k = static_cast<double>(bins - 1), b = 2 / (9 * k);
  const double root = 1 - b + std::sqrt(b) * parameters.pf_z;  // Wilson and Hilferty's quantile of chi-square
  const double count = std::ceil(k / (2 * parameters.pf_err) * root * root * root);
  return static_cast<int>(
      std::clamp(count, static_cast<double>(parameters.min_particles), static_cast<double>(parameters.max_particles)));
}

std::vector<Particle> resampled(std::span<const Particle> particles, const Parameters& parameters, double random,
                                const Places& places, sim::Draws& draws) {
  std::vector<double> sum(particles.size());
  double total = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) sum[i] = total += particles[i].weight;
  std::vector<Particle> drawn;
  std::unordered_set<Bin, BinHash> bins;
  int wanted = parameters.min_particles;
  while (static_cast<int>(drawn.size()) < wanted) {
    if (random > 0 && !places.centres.empty() && draws.uniform() < random) {
      drawn.push_back({anywhere(places, draws), 0});
    } else {
      const auto found = std::upper_bound(sum.begin(), sum.end(), draws.uniform() * total);
      const auto index = std::min<std::size_t>(static_cast<std::size_t>(found - sum.begin()), sum.size() - 1);
      drawn.push_back(particles[index]);
    }
    if (bins.insert(Bin::of(drawn.back().pose)).second) wanted = particles_for(bins.size(), parameters);
  }
  for (Particle& it : drawn) it.weight = 1 / static_cast<double>(drawn.size());
  return drawn;
}

}  // namespace mrpbench::amcl
