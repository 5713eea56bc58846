// Regulated pure pursuit for differential drive.
//
// Steers the arc that leads to a point of the path a fixed distance ahead (Coulter, "Implementation of the Pure Pursuit
// Path Tracking Algorithm", CMU-RI-TR-92-01, 1992), slows down in tight turns and before the end, and turns on the spot
// where the path leads elsewhere (Macenski, Singh, Martín and Ginés, "Regulated Pure Pursuit for Robot Path Tracking",
// Autonomous Robots 47, 2023).
#pragma once

#include <cstdint>
#include <span>

#include "mrpbench_sim/plane.hpp"

namespace mrpbench::navigation {

using sim::Point;
using sim::Pose;
using sim::Twist;

/// Options by the names of Nav2's controller, and what follows from the robot.
struct PursuitOptions {
  double period = 0;  // seconds of simulated time, as all below
  double lookahead_dist = 0;
  bool use_rotate_to_heading = true, use_regulated_linear_velocity_scaling = true;
  double rotate_to_heading_min_angle = 0, angular_disengage_threshold = 0;
  double regulated_linear_scaling_min_radius = 0, regulated_linear_scaling_min_speed = 0;
};

struct PursuingRobot {
  double cruise = 0, spin = 0;  // m/s, and rad/s on the spot
  double max_turn_rate = 0;     // rad/s
  double acceleration = 0, turn_acceleration = 0;
};

/// What a controller knows of one robot. The path is `foot`, then `points`, at least one.
struct Pursuit {
  Pose pose;
  Twist twist;
  Point foot;
  std::span<const Point> points;
  double yaw = 0, speed = 0;  // to take at the last point, NaN = any; allowed now
};

/// The first point of a path, prolonged straight beyond its end, that is `distance` metres from a robot. If a path
/// begins farther away than that, it is the first point of the path.
Point carrot(Point first, std::span<const Point> points, Point robot, double distance);

/// The length of a path in metres; of a longer path at least `enough`.
double path_length(Point first, std::span<const Point> points, double enough);

/// The highest speed, kept for one period, from which a robot can still stop within the distance.
double stopping_speed(double distance, double acceleration, double period);

/// An angle in radians as -pi < angle <= pi.
double wrapped(double angle);

/// The command of one robot, which turns on the spot or does not.
Twist pursue(const PursuitOptions& options, const PursuingRobot& robot, const Pursuit& seen, bool& turning);

}  // namespace mrpbench::navigation
