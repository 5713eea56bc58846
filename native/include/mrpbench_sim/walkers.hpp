// People who walk: their forces or velocity obstacles, and their motion, which no wall, robot or other person permits
// to overlap.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mrpbench_options/options.hpp"
#include "mrpbench_sim/contacts.hpp"

namespace mrpbench::sim {

/// How people walk. Defaults of the forces are those of lightsfm, those of the velocity obstacles ours for people.
struct WalkerOptions {
  double interaction = 2.1, relaxation = 0.5, goal_factor = 2, wall_force = 10, wall_reach = 0.2, side = 0.005;
  double gaze = 3, coherence = 2, repulsion = 1;
  double horizon = 2, wall_horizon = 1, sight = 5;
  bool orca = false;

  static Description<WalkerOptions> description();
};

struct Walker {
  Point place, velocity;
};

/// The social force from `other` on `me`, m/s² (M. Moussaïd et al., "Experimental study of the behavioural mechanisms
/// underlying self-organization in human crowds", Proc. R. Soc. B 276, 2009). `side` turns the angle of people who meet
/// head-on, who would stop without it.
Point social_force(const Walker& me, const Walker& other, double strength, double side);

/// A half-plane of velocities: those to the left of a line.
struct HalfPlane {
  Point point, direction;
};

/// The velocities that avoid a disc for `horizon` seconds (J. van den Berg et al., "Reciprocal n-body collision
/// avoidance", ISRR 2009), of which `share` is left to me: 1/2 if the other does the same, else 1.
HalfPlane avoiding(const Walker& me, const Walker& other, double radii, double horizon, double dt, double share);

/// The velocity within `fastest` and the half-planes that is nearest to `wanted`; the first `hard` half-planes hold,
/// and the others as far as possible.
Point nearest_velocity(std::span<const HalfPlane> planes, std::size_t hard, double fastest, Point wanted);

class Walkers {
 public:
  /// People with `radius`, largest speeds and groups (-1 = none), at places that are free, with `velocities` (none =
  /// all stand).
  Walkers(std::vector<Segment> segments, std::vector<double> radius, std::vector<double> speed, std::vector<int> group,
          std::vector<Point> places, const WalkerOptions& options, std::vector<Point> velocities = {});

  /// How a person regards the robots.
  enum Regard : unsigned char { as_people, as_obstacles, not_at_all };

  struct Wishes {
    /// m/s, for each person.
    std::span<const Point> velocity;
    /// Further accelerations, m/s².
    std::span<const Point> push;
    std::span<const unsigned char> regard;
  };

  /// Walk for `dt` seconds among `others`, of which the first `robots` are robots; they have `radius`.
  void step(double dt, const Wishes& wishes, std::span<const Walker> others, std::span<const double> radius,
            std::size_t robots, std::span<const Segment> leaves);

  const std::vector<Point>& places() const { return places_; }
  /// Of the last step over ground.
  const std::vector<Point>& velocities() const { return velocities_; }
  std::size_t size() const { return places_.size(); }

 private:
  struct Scene {
    const Wishes& wishes;
    std::span<const Walker> others;
    std::span<const double> radius;
    std::size_t robots;
    std::span<const Segment> leaves;
  };

  Point forced(std::size_t me, double dt, const Scene& scene) const;
  Point avoided(std::size_t me, double dt, const Scene& scene) const;
  Point of_group(std::size_t me, Point wanted) const;
  Point beside_robots(std::size_t me, double dt, const Scene& scene, Point wanted) const;
  void move(double dt, const Scene& scene);
  Walker walker(std::size_t disc, const Scene& scene) const;
  template <class Visit>
  void walls(Point centre, const Scene& scene, Visit&& visit) const;

  std::vector<Segment> segments_;
  std::vector<double> radius_, speed_;
  double largest_robot_ = 0;
  std::vector<int> group_;
  std::vector<Point> places_, velocities_, next_;
  WalkerOptions options_;
  SegmentBuckets buckets_;
  DiscHash hash_;
  std::optional<Contacts> contacts_;
  std::vector<double> others_radius_;
  std::vector<Touch> touches_;
  std::vector<std::vector<std::size_t>> groups_;
};

}  // namespace mrpbench::sim
