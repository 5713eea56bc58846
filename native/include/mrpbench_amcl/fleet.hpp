// Adaptive Monte Carlo localisation of a fleet: every robot its own filter, all on one map.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_amcl/estimate.hpp"
#include "mrpbench_amcl/likelihood_field.hpp"
#include "mrpbench_amcl/parameters.hpp"
#include "mrpbench_amcl/resampling.hpp"

namespace mrpbench::amcl {

/// Scans of several robots, row by row, by lidars of one kind.
struct Scans {
  std::span<const int> robots;
  std::span<const double> ranges;
  double range = 0, min_range = 0;
  Point mount;
};

class Fleet {
 public:
  /// Throws std::invalid_argument for invalid parameters.
  Fleet(const std::vector<sim::Segment>& segments, double resolution, Places places, std::vector<Pose> placements,
        const Parameters& parameters, std::uint64_t seed);

  /// Set the odometry at the placements, one pose for each robot; call this once, before all other methods.
  void begin(std::span<const Pose> odometry);

  /// Update from scans taken at `odometry`. A robot's first scan is used, later ones only after it has moved.
  void sense(const Scans& scans, std::span<const Pose> odometry);

  /// The pose of a robot: its last estimate, moved by the odometry since then.
  Pose pose(std::size_t robot, Pose odometry) const;
  const Estimate& estimate(std::size_t robot) const { return filters_[robot].estimate; }
  std::span<const Particle> particles(std::size_t robot) const { return filters_[robot].particles; }
  std::size_t size() const { return filters_.size(); }

 private:
  struct Filter {
    std::vector<Particle> particles;
    Estimate estimate;
    Pose odometry;
    double slow = 0, fast = 0;
    std::uint64_t updates = 0;
    bool scanned = false;
  };

  void check(std::span<const Pose> odometry) const;
  void update(Filter& filter, std::size_t robot, Pose odometry, const Ends& ends) const;

  Parameters parameters_;
  LikelihoodField field_;
  Places places_;
  std::uint64_t seed_;
  std::vector<Filter> filters_;
};

}  // namespace mrpbench::amcl
