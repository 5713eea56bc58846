// How likely a scan is: the likelihood field of S. Thrun, W. Burgard and D. Fox, "Probabilistic Robotics", MIT Press
// 2005, section 6.4. A likelihood depends on the distance from the end of a beam to the nearest wall, not on its path.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_amcl/parameters.hpp"
#include "mrpbench_amcl/particle.hpp"

namespace mrpbench::amcl {

/// Where beams end in the robot's frame, and the likelihood of any range of theirs.
struct Ends {
  std::vector<Point> points;
  double anywhere = 0;
};

/// The ends of at most `max_beams` of a scan's beams; those without a return within the range are left out.
Ends ends_of(std::span<const double> ranges, double range, double min_range, Point mount, const Parameters& parameters);

class LikelihoodField {
 public:
  /// Squares of side `resolution`, up to the largest distance that matters from walls.
  LikelihoodField(const std::vector<sim::Segment>& segments, double resolution, const Parameters& parameters);

  /// Multiply each particle's weight by the likelihood of a scan; returns the sum of the weights.
  double weigh(std::span<Particle> particles, const Ends& ends) const;

  /// Likelihood of a hit at a point, times `z_hit`.
  double hit(Point point) const;

  std::size_t size() const { return hit_.size(); }

 private:
  template <class Visit>
  void each(Pose pose, const Ends& ends, Visit&& visit) const;
  double add_cubes(std::span<Particle> particles, const Ends& ends) const;
  double multiply(std::span<Particle> particles, const Ends& ends) const;

  bool independent_;
  Point origin_;
  double per_metre_, resolution_;
  std::size_t columns_ = 0, rows_ = 0;
  float nothing_;
  std::vector<float> hit_;
};

}  // namespace mrpbench::amcl
