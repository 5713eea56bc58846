#include "mrpbench_amcl/estimate.hpp"

#include <unordered_map>
#include <vector>

namespace mrpbench::amcl {

namespace {

/// The cluster of each particle, by numbers in the order of their first particles.
std::vector<int> clusters(std::span<const Particle> particles, int& count) {
  std::unordered_map<Bin, int, BinHash> cluster;  // -1 = not assigned yet
  for (const Particle& it : particles) cluster.emplace(Bin::of(it.pose), -1);
  std::vector<int> of_particle;
  std::vector<Bin> frontier;
  count = 0;
  for (const Particle& particle : particles) {
    const Bin bin = Bin::of(particle.pose);
    if (cluster[bin] < 0) {
      cluster[bin] = count;
      frontier.push_back(bin);
      while (!frontier.empty()) {
        const Bin at = frontier.back();
        frontier.pop_back();
        for (int i = 0; i < 27; ++i) {
          const Bin next{at.column + i % 3 - 1, at.row + i / 3 % 3 - 1,
                         (at.turn + i / 9 - 1 + Bin::kTurn) % Bin::kTurn};
          const auto found = cluster.find(next);
          if (found == cluster.end() || found->second >= 0) continue;
          found->second = count;
          frontier.push_back(next);
        }
      }
      ++count;
    }
    of_particle.push_back(cluster[bin]);
  }
  return of_particle;
}

}  // namespace

Estimate estimate(std::span<const Particle> particles) {
  int count = 0;
  const std::vector<int> cluster = clusters(particles, count);
  std::vector<double> weight(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < particles.size(); ++i) {
    weight[static_cast<std::size_t>(cluster[i])] += particles[i].weight;
  }
  int heaviest = 0;
  for (int i = 1; i < count; ++i) {
    if (weight[static_cast<std::size_t>(i)] > weight[static_cast<std::size_t>(heaviest)]) heaviest = i;
  }
  const double total = weight[static_cast<std::size_t>(heaviest)];
  double x = 0, y = 0, cosine = 0, sine = 0;
  const auto each = [&](auto&& visit) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (cluster[i] == heaviest) visit(particles[i].pose, particles[i].weight / total);
    }
  };
  each([&](const Pose& pose, double share) {
    x += share * pose.x;
    y += share * pose.y;
    cosine += share * std::cos(pose.yaw);
    sine += share * std::sin(pose.yaw);
  });
  Estimate result{{x, y, std::atan2(sine, cosine)}, {}};
  each([&](const Pose& pose, double share) {
    const double off[3] = {pose.x - x, pose.y - y, wrapped(pose.yaw - result.pose.yaw)};
    for (int i = 0; i < 9; ++i) result.covariance[static_cast<std::size_t>(i)] += share * off[i / 3] * off[i % 3];
  });
  return result;
}

}  // namespace mrpbench::amcl
