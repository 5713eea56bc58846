#include "mrpbench_navigation/pure_pursuit.hpp"

#include <cmath>
#include <numbers>

#include "mrpbench_navigation/routes.hpp"

namespace mrpbench::navigation {

namespace {

constexpr double at_end = 0.02;       // metres before the end at which a robot turns to the final yaw
constexpr double back_to_end = 0.05;  // metres: a robot pushed farther than this from the end drives straight to it

double lesser(double one, double other) {
  return one < other ? one : other;
}
double greater(double one, double other) {
  return one > other ? one : other;
}

/// The length of a step: most legs are parallel to an axis, where it needs no root.
double norm(Point step) {
  if (step.x == 0) return std::abs(step.y);
  return step.y == 0 ? std::abs(step.x) : std::hypot(step.x, step.y);
}

double apart(Point one, Point other) {
  return norm({one.x - other.x, one.y - other.y});
}

/// `wanted`, limited to what is within `change` of the measured speed.
double limited(double wanted, double measured, double change) {
  return lesser(greater(wanted, measured - change), measured + change);
}

/// Cruising speed, reduced in tight turns.
double regulated(const PursuitOptions& options, const PursuingRobot& robot, double curvature) {
  const double bend = greater(std::abs(curvature), 1e-9);
  double speed = robot.cruise;
  if (options.use_regulated_linear_velocity_scaling) {
    const double slow = speed / greater(bend * options.regulated_linear_scaling_min_radius, 1.0);
    speed = lesser(speed, greater(slow, options.regulated_linear_scaling_min_speed));
  }
  return lesser(speed, robot.max_turn_rate / bend);
}

/// Turn on the spot once the heading is far off, and then until it is nearly right.
bool must_turn(const PursuitOptions& options, double error, bool turning) {
  if (!options.use_rotate_to_heading) return false;
  return error > (turning ? options.angular_disengage_threshold : options.rotate_to_heading_min_angle);
}

double turn_rate(const PursuitOptions& options, const PursuingRobot& robot, double error) {
  const double rate = stopping_speed(std::abs(error), robot.turn_acceleration, options.period);
  return std::copysign(lesser(robot.spin, rate), error);
}

/// Close to the end a robot drives there slowly, or turns to the prescribed yaw.
Twist rest(const PursuitOptions& options, const PursuingRobot& robot, const Pursuit& seen, double stopping,
           bool turning) {
  const double change = robot.acceleration * options.period;
  if (!std::isnan(seen.yaw)) return {0.0, turn_rate(options, robot, wrapped(seen.yaw - seen.pose.yaw))};
  return {limited(turning ? 0.0 : stopping, seen.twist.ahead, change), turning ? turn_rate(options, robot, 0.0) : 0.0};
}

}  // namespace

Point carrot(Point first, std::span<const Point> points, Point robot, double distance) {
  if (!(beyond(first.x - robot.x, first.y - robot.y, distance) < 0)) return first;
  Point start = first, along;
  for (const Point& ahead : points) {
    const Point step{ahead.x - start.x, ahead.y - start.y};
    const bool longer = step.x != 0 || step.y != 0;
    if (longer) along = step;
    if (longer && beyond(ahead.x - robot.x, ahead.y - robot.y, distance) >= 0) break;
    start = ahead;
  }
  const double way = norm(along);
  if (!(way > 0)) return start;
  along = {along.x / way, along.y / way};
  // `start` lies inside the circle around the robot; the ray from there along the leg leaves it once.
  const Point offset{robot.x - start.x, robot.y - start.y};
  const double ahead_by = offset.x * along.x + offset.y * along.y;
  const double beside = offset.x * along.y - offset.y * along.x;
  const double share = ahead_by + std::sqrt(greater(distance * distance - beside * beside, 0.0));
  return {start.x + share * along.x, start.y + share * along.y};
}

double path_length(Point first, std::span<const Point> points, double enough) {
  double way = 0;
  for (const Point& ahead : points) {
    way += apart(ahead, first);
    if (way >= enough) break;
    first = ahead;
  }
  return way;
}

double stopping_speed(double distance, double acceleration, double period) {
  return acceleration * (std::sqrt(period * period + 2 * distance / acceleration) - period);
}

double wrapped(double angle) {
  return std::numbers::pi - modulo(std::numbers::pi - angle, 2 * std::numbers::pi);
}

Twist pursue(const PursuitOptions& options, const PursuingRobot& robot, const Pursuit& seen, bool& turning) {
  const double braking = robot.cruise * options.period + robot.cruise * robot.cruise / (2 * robot.acceleration);
  const Point place{seen.pose.x, seen.pose.y};
  Point first = seen.foot;
  std::span<const Point> points = seen.points;
  double left = path_length(first, points, braking);
  bool resting = false;
  if (left <= at_end) {
    const double away = apart(seen.points.back(), place);
    resting = away <= back_to_end;
    if (!resting && left == 0) {  // away from the end of a path of which nothing is left
      first = place;
      points = points.last(1);
      left = away;
    }
  }
  const Point aim = carrot(first, points, place, options.lookahead_dist);
  const Point offset{aim.x - place.x, aim.y - place.y};
  const double distance = norm(offset);
  const double error = distance > 0 ? wrapped(std::atan2(offset.y, offset.x) - seen.pose.yaw) : 0.0;
  const bool turns = must_turn(options, std::abs(error), turning);
  const double stopping = lesser(stopping_speed(left, robot.acceleration, options.period), seen.speed);
  if (resting) return rest(options, robot, seen, stopping, turns);
  turning = turns;
  const double curvature = distance > 0 ? 2 * std::sin(error) / distance : 0.0;
  const double wanted = limited(turns ? 0.0 : lesser(regulated(options, robot, curvature), stopping), seen.twist.ahead,
                                robot.acceleration * options.period);
  if (turns) return {wanted, turn_rate(options, robot, error)};
  return {wanted, limited(wanted * curvature, seen.twist.turn, robot.turn_acceleration * options.period)};
}

}  // namespace mrpbench::navigation
