// Robots with differential drives in a plane of walls and movers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_options/options.hpp"
#include "mrpbench_sim/contacts.hpp"
#include "mrpbench_sim/drive.hpp"

namespace mrpbench::sim {

struct Pose {
  double x = 0, y = 0, yaw = 0;
};

/// Noise; 0 = none.
struct Chance {
  double slip = 0, actuation = 0;
  std::uint64_t seed = 0;

  static Description<Chance> description() {
    return {{"slip", &Chance::slip, within(0, 0.5),
             "mean share of its travel that a wheel loses; drawn for each wheel and period, from 0 to twice that"},
            {"actuation_noise", &Chance::actuation, at_least(0),
             "standard deviation of the relative error of speed and turn rate, which is drawn every period"}};
  }
};

class Plane {
 public:
  /// The first radii are those of the robots, the others those of the movers, which are absent until `step` places
  /// them. Throws std::invalid_argument for sizes that do not match and invalid numbers.
  Plane(std::vector<Segment> segments, std::vector<double> radius, std::vector<Drive> drives, std::vector<Pose> poses,
        double period, Chance chance);

  /// Advance by one control period, in which movers move straight to their places; without places they stay.
  void step(std::span<const Twist> commands, std::span<const Point> movers);

  /// Replace the door leaves, which are solid in addition to the segments of the constructor.
  void set_leaves(std::span<const Segment> leaves) { contacts_.set_leaves(leaves); }

  /// Move a robot with its yaw and speed, for example because a lift carried it to another level.
  void place(int robot, Point where);

  const std::vector<Pose>& poses() const { return poses_; }
  /// Over ground.
  const std::vector<Twist>& twists() const { return twists_; }
  /// Of the last step, in order, each once.
  const std::vector<Touch>& touches() const { return touches_; }
  std::size_t mover_count() const { return centres_.size() - poses_.size(); }

 private:
  void command(std::span<const Twist> commands);
  void advance(double dt);

  std::vector<Drive> drives_;
  std::vector<Pose> poses_;
  std::vector<Twist> driven_, twists_, wanted_;
  std::vector<Slip> slips_;
  std::vector<Point> centres_, before_, free_, heading_, begin_;
  std::vector<Touch> touches_;
  double period_;
  /// Metres: what a disc may move in a sub-step, and what a robot can move in a period.
  double stride_ = 0, reach_ = 0;
  std::uint64_t periods_ = 0;
  Chance chance_;
  Contacts contacts_;
};

}  // namespace mrpbench::sim
