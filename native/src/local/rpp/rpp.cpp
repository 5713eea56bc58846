// Regulated pure pursuit, and its variant with a dynamic window (S. Macenski, S. Singh, F. Martin and J. Gines,
// "Regulated pure pursuit for robot path tracking", Autonomous Robots 47, 2023; F. Ohnishi and M. Takahashi, "DWPP:
// dynamic window pure pursuit considering velocity and acceleration constraints", 2026; this second reference is not
// verified), with the parameters of Nav2.
#include <algorithm>
#include <limits>

#include "mrpbench_local/controller.hpp"
#include "mrpbench_local/costmap/collision.hpp"
#include "mrpbench_local/costmap/footprint.hpp"

namespace mrpbench::local {

namespace {

struct RppOptions {
  double max_linear_vel = 0.5, min_linear_vel = -0.5, max_angular_vel = 2.5, min_angular_vel = -2.5;
  double max_linear_accel = 2.5, max_linear_decel = -2.5, max_angular_accel = 3.2, max_angular_decel = -3.2;
  double lookahead_dist = 0.6, min_lookahead_dist = 0.3, max_lookahead_dist = 0.9, lookahead_time = 1.5;
  bool use_velocity_scaled_lookahead_dist = false, use_fixed_curvature_lookahead = false;
  double curvature_lookahead_dist = 0.6;
  bool interpolate_curvature_after_goal = false;
  bool use_rotate_to_heading = true, allow_reversing = false;
  double rotate_to_heading_min_angle = 0.785, rotate_to_heading_angular_vel = 1.8;
  double min_approach_linear_velocity = 0.05, approach_velocity_scaling_dist = 0.6;
  bool use_regulated_linear_velocity_scaling = true, use_cost_regulated_linear_velocity_scaling = true;
  double regulated_linear_scaling_min_radius = 0.9, regulated_linear_scaling_min_speed = 0.25;
  double cost_scaling_dist = 0.6, cost_scaling_gain = 1, inflation_cost_scaling_factor = 3;
  bool use_collision_detection = true, use_dynamic_window = false;
  double max_allowed_time_to_collision_up_to_carrot = 1;
  double period = 0.05;

  static Description<RppOptions> nav2() {
    using R = RppOptions;
    return {
        {"max_linear_vel", &R::max_linear_vel, above(0, "m/s"), "cruising speed, within the robot's limit"},
        {"min_linear_vel", &R::min_linear_vel, within(-1000, 0, "m/s"), "lowest speed of the dynamic window"},
        {"max_angular_vel", &R::max_angular_vel, above(0, "rad/s"), "highest turn rate, within the robot's limit"},
        {"min_angular_vel", &R::min_angular_vel, within(-1000, 0, "rad/s"),
         "lowest turn rate, within the robot's limit"},
        {"max_linear_accel", &R::max_linear_accel, above(0), "acceleration of the dynamic window, m/s^2"},
        {"max_linear_decel", &R::max_linear_decel, any(""), "deceleration of the dynamic window, negative, m/s^2"},
        {"max_angular_accel", &R::max_angular_accel, above(0),
         "acceleration of the dynamic window and on the spot, rad/s^2"},
        {"max_angular_decel", &R::max_angular_decel, any(""), "deceleration of the dynamic window, negative, rad/s^2"},
        {"lookahead_dist", &R::lookahead_dist, above(0, "m").usually(0.3, 1.2),
         "distance along the path of the point that is chased"},
        {"min_lookahead_dist", &R::min_lookahead_dist, above(0, "m").usually(0.2, 0.6),
         "least distance, if it scales with the speed"},
        {"max_lookahead_dist", &R::max_lookahead_dist, above(0, "m").usually(0.6, 1.5),
         "greatest distance, if it scales with the speed"},
        {"lookahead_time", &R::lookahead_time, above(0, "s").usually(0.8, 2.5),
         "distance per speed, if it scales with the speed"},
        {"use_velocity_scaled_lookahead_dist", &R::use_velocity_scaled_lookahead_dist,
         "scale the distance of the point that is chased with the speed"},
        {"use_fixed_curvature_lookahead", &R::use_fixed_curvature_lookahead,
         "take the curvature from the point at curvature_lookahead_dist"},
        {"curvature_lookahead_dist", &R::curvature_lookahead_dist, above(0, "m").usually(0.3, 1.2),
         "distance of that point"},
        {"interpolate_curvature_after_goal", &R::interpolate_curvature_after_goal,
         "prolong the path straight beyond its end to find the points ahead"},
        {"use_rotate_to_heading", &R::use_rotate_to_heading,
         "turn on the spot where the path leads far off the heading, and at its end"},
        {"allow_reversing", &R::allow_reversing, "drive back to a point behind the robot"},
        {"rotate_to_heading_min_angle", &R::rotate_to_heading_min_angle, above(0).usually(0.3, 1.5),
         "turn on the spot if the heading is off by more than this, radians"},
        {"rotate_to_heading_angular_vel", &R::rotate_to_heading_angular_vel, above(0, "rad/s").usually(0.5, 3),
         "turn rate on the spot, within the robot's limit"},
        {"min_approach_linear_velocity", &R::min_approach_linear_velocity, above(0, "m/s").usually(0.02, 0.2),
         "lowest speed near the end of the path"},
        {"approach_velocity_scaling_dist", &R::approach_velocity_scaling_dist, above(0, "m").usually(0.2, 1),
         "slow down in proportion within this distance of the end of the path"},
        {"use_regulated_linear_velocity_scaling", &R::use_regulated_linear_velocity_scaling,
         "slow down in tight turns"},
        {"use_cost_regulated_linear_velocity_scaling", &R::use_cost_regulated_linear_velocity_scaling,
         "slow down near obstacles"},
        {"regulated_linear_scaling_min_radius", &R::regulated_linear_scaling_min_radius,
         above(0, "m").usually(0.3, 1.2), "slow down in turns tighter than this radius, in proportion"},
        {"regulated_linear_scaling_min_speed", &R::regulated_linear_scaling_min_speed,
         at_least(0, "m/s").usually(0.05, 0.5), "lowest speed in tight turns and near obstacles"},
        {"cost_scaling_dist", &R::cost_scaling_dist, above(0, "m").usually(0.2, 1),
         "slow down within this distance of obstacles"},
        {"cost_scaling_gain", &R::cost_scaling_gain, above(0).usually(0.3, 1),
         "factor of the speed within that distance"},
        {"inflation_cost_scaling_factor", &R::inflation_cost_scaling_factor, above(0),
         "cost_scaling_factor of the costmap, from which distances of obstacles follow, 1/m"},
        {"use_collision_detection", &R::use_collision_detection, "command nothing that soon leads to a collision"},
        {"max_allowed_time_to_collision_up_to_carrot", &R::max_allowed_time_to_collision_up_to_carrot,
         above(0, "s").usually(0.5, 2), "look this far ahead for collisions, at most up to the point that is chased"},
        {"use_dynamic_window", &R::use_dynamic_window,
         "choose among the velocities that accelerations allow the one that best keeps the curvature"}};
  }
  static Description<RppOptions> further() { return {}; }
  static Description<RppOptions> derived() {
    return {{"period", &RppOptions::period, above(0, "s"), "control period"}};
  }
};

struct Window {
  double low = 0, high = 0;
};

/// What one period allows from a velocity; `decel` is negative.
Window reachable(double now, double accel, double decel, double least, double most, double period) {
  const double faster = accel * period, slower = now == 0 ? faster : -decel * period;
  const Window window = now >= 0 ? Window{now - slower, now + faster} : Window{now - faster, now + slower};
  return {std::clamp(window.low, least, most), std::clamp(window.high, least, most)};
}

/// The velocity of a window on the line turn = curvature * ahead that is fastest, or else the corner nearest to the
/// line.
Twist on_curvature(Window ahead, Window turn, double curvature, bool back) {
  const auto fits = [&](double v) {
    constexpr double slack = 1e-12;
    const double w = curvature * v;
    return v >= ahead.low - slack && v <= ahead.high + slack && w >= turn.low - slack && w <= turn.high + slack;
  };
  std::vector<double> candidates{ahead.low, ahead.high};
  if (curvature != 0) candidates.insert(candidates.end(), {turn.low / curvature, turn.high / curvature});
  std::optional<double> best;
  for (const double v : candidates) {
    if (fits(v) && (!best || (back ? v < *best : v > *best))) best = v;
  }
  if (best) return {*best, curvature * *best};
  Twist nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const double v : {ahead.low, ahead.high}) {
    for (const double w : {turn.low, turn.high}) {
      const double away = std::abs(curvature * v - w);
      if (away > least || (away == least && (back ? v >= nearest.ahead : v <= nearest.ahead))) continue;
      least = away;
      nearest = {v, w};
    }
  }
  return nearest;
}

class Rpp : public Controller {
 public:
  using Options = RppOptions;

  Rpp(const RppOptions& options, const RobotOptions& robot) : options_(options), by_radius_(robot.by_radius) {
    for (const Point& p : robot.costmap.footprint) circumscribed_ = std::max(circumscribed_, sim::length(p));
    if (options.use_rotate_to_heading && options.allow_reversing) {
      throw std::invalid_argument("allow_reversing excludes use_rotate_to_heading");
    }
    if (options.max_linear_decel >= 0 || options.max_angular_decel >= 0) {
      throw std::invalid_argument("decelerations must be negative");
    }
    if (options.min_lookahead_dist > options.max_lookahead_dist) {
      throw std::invalid_argument("min_lookahead_dist exceeds max_lookahead_dist");
    }
  }

  std::optional<Twist> command(const Situation& now, const Extra&) override {
    const std::vector<Point> path = from_nearest(in_frame_of(now.pose, now.path), now.costmap->options().width / 2);
    fault_ = "";
    const double lookahead = lookahead_distance(now.twist.ahead);
    carrot_ = point_at(path, lookahead, options_.interpolate_curvature_after_goal);
    speed_ = 0;
    curvature_ =
        curvature_to(options_.use_fixed_curvature_lookahead
                         ? point_at(path, options_.curvature_lookahead_dist, options_.interpolate_curvature_after_goal)
                         : carrot_);
    last_ = choose(now, path);
    if (options_.use_collision_detection && last_ != Twist{} && collides(now, last_)) {
      fault_ = "a collision is ahead";
      last_ = {};
      return std::nullopt;
    }
    return last_;
  }

  /// `carrot` f8[2] in the robot's frame, `curvature` 1/m, `speed` m/s after all regulation, and the `reason` why there
  /// is not a command.
  Explanation explain() const override {
    return {{{"carrot", {{carrot_.x, carrot_.y}, {2}}}, {"curvature", {{curvature_}, {1}}}, {"speed", {{speed_}, {1}}}},
            {{"reason", {fault_}}}};
  }

 private:
  double lookahead_distance(double speed) const {
    if (!options_.use_velocity_scaled_lookahead_dist) return options_.lookahead_dist;
    return std::clamp(std::abs(speed) * options_.lookahead_time, options_.min_lookahead_dist,
                      options_.max_lookahead_dist);
  }

  static double curvature_to(Point p) {
    const double squared = p.x * p.x + p.y * p.y;
    return squared > 0.001 ? 2 * p.y / squared : 0;
  }

  Twist choose(const Situation& now, const std::vector<Point>& path) {
    const double away = sim::length(path.back());
    // The goal checker of the navigator judges by the same distance, so stop a little later than it is satisfied.
    if (away <= now.path.tolerance / 2) {
      if (std::isnan(now.path.yaw)) return {};
      return turned(now, wrapped(now.path.yaw - now.pose.yaw));
    }
    const double bearing = std::atan2(carrot_.y, carrot_.x);
    if (options_.use_rotate_to_heading && std::abs(bearing) > options_.rotate_to_heading_min_angle) {
      return turned(now, bearing);
    }
    const double sign = options_.allow_reversing && carrot_.x < 0 ? -1 : 1;
    const double fastest = std::min(options_.max_linear_vel, now.path.speed);
    speed_ = std::min(fastest, regulated(now, path)) * sign;
    if (options_.use_dynamic_window) return within_window();
    // Keep the curvature where the turn rate is limited.
    const double turn = speed_ * curvature_;
    const double limited = std::clamp(turn, options_.min_angular_vel, options_.max_angular_vel);
    return turn == limited ? Twist{speed_, turn} : Twist{limited / curvature_, limited};
  }

  /// The cruising speed, lowered in tight turns, near obstacles and near the end of the path.
  double regulated(const Situation& now, const std::vector<Point>& path) const {
    const RppOptions& it = options_;
    double speed = it.max_linear_vel;
    if (it.use_regulated_linear_velocity_scaling && curvature_ != 0) {
      const double radius = 1 / std::abs(curvature_);
      const double widest = it.regulated_linear_scaling_min_radius;
      if (radius < widest) speed = std::min(speed, it.max_linear_vel * radius / widest);
    }
    if (it.use_cost_regulated_linear_velocity_scaling) {
      const Cell c = now.costmap->frame().cell({now.pose.x, now.pose.y});
      const int cost = now.costmap->frame().holds(c) ? now.costmap->at(c) : 0;
      if (cost > 0) {
        const double distance = now.costmap->inscribed() + std::log(253.0 / cost) / it.inflation_cost_scaling_factor;
        if (distance < it.cost_scaling_dist) {
          speed = std::min(speed, it.max_linear_vel * it.cost_scaling_gain * distance / it.cost_scaling_dist);
        }
      }
    }
    speed = std::max(speed, it.regulated_linear_scaling_min_speed);
    if (length_of(path) < it.approach_velocity_scaling_dist) {
      speed = std::min(speed, std::max(it.min_approach_linear_velocity,
                                       speed * sim::length(path.back()) / it.approach_velocity_scaling_dist));
    }
    return speed;
  }

  /// Turn on the spot, so fast that the robot can stop at the wanted heading.
  Twist turned(const Situation& now, double angle) const {
    const double wanted = std::copysign(options_.rotate_to_heading_angular_vel, angle);
    const double change = options_.max_angular_accel * options_.period;
    double rate = std::clamp(wanted, now.twist.turn - change, now.twist.turn + change);
    const double stopping = std::sqrt(2 * options_.max_angular_accel * std::abs(angle));
    if (rate * angle > 0)
      rate = std::copysign(std::min({std::abs(rate), stopping, std::abs(angle) / options_.period}), rate);
    return {0, std::clamp(rate, options_.min_angular_vel, options_.max_angular_vel)};
  }

  Twist within_window() const {
    const RppOptions& it = options_;
    Window ahead = reachable(last_.ahead, it.max_linear_accel, it.max_linear_decel, it.min_linear_vel,
                             it.max_linear_vel, it.period);
    const Window turn = reachable(last_.turn, it.max_angular_accel, it.max_angular_decel, it.min_angular_vel,
                                  it.max_angular_vel, it.period);
    const Window allowed{std::min(0.0, speed_), std::max(0.0, speed_)};
    ahead = {std::clamp(allowed.low, ahead.low, ahead.high), std::clamp(allowed.high, ahead.low, ahead.high)};
    return on_curvature(ahead, turn, curvature_, speed_ < 0);
  }

  /// Tell whether the robot collides now, or soon along the arc of a command.
  bool collides(const Situation& now, Twist command) const {
    Pose pose = now.pose;
    const double resolution = now.costmap->frame().resolution;
    if (!is_free(*now.costmap, pose, by_radius_)) return true;
    const bool on_the_spot = std::abs(command.ahead) < 0.01;
    if (on_the_spot && std::abs(command.turn) < 0.01) return false;
    const double step =
        on_the_spot ? 2 * std::sin(resolution / 2 / std::max(circumscribed_, resolution)) / std::abs(command.turn)
                    : resolution / std::abs(command.ahead);
    const double farthest = sim::length(carrot_);
    for (double time = step; time <= options_.max_allowed_time_to_collision_up_to_carrot; time += step) {
      pose.x += command.ahead * std::cos(pose.yaw) * step;
      pose.y += command.ahead * std::sin(pose.yaw) * step;
      pose.yaw += command.turn * step;
      if (sim::length(Point{pose.x, pose.y} - Point{now.pose.x, now.pose.y}) > farthest) return false;
      if (!is_free(*now.costmap, pose, by_radius_)) return true;
    }
    return false;
  }

  RppOptions options_;
  bool by_radius_;
  double circumscribed_ = 0;
  Twist last_;
  Point carrot_;
  double curvature_ = 0, speed_ = 0;
  const char* fault_ = "";
};

}  // namespace

ControllerKind rpp() {
  return controller_of<Rpp>();
}

}  // namespace mrpbench::local
