// Graceful motion to a moving target on the path (J. J. Park and B. Kuipers, "A smooth control law for graceful motion
// of differential wheeled mobile robots in 2D environment", ICRA 2011), with the parameters of Nav2.
#include <algorithm>

#include "mrpbench_local/controller.hpp"
#include "mrpbench_local/costmap/collision.hpp"

namespace mrpbench::local {

namespace {

struct GracefulOptions {
  double max_lookahead = 1, k_phi = 2, k_delta = 1, beta = 0.4, lambda = 2;
  double v_linear_min = 0.1, v_linear_max = 0.5, v_angular_max = 1, v_angular_min_in_place = 0.25;
  double slowdown_radius = 1.5, deceleration_max = 2.5;
  bool initial_rotation = true, prefer_final_rotation = true, allow_backward = false;
  double initial_rotation_tolerance = 0.75, rotation_scaling_factor = 0.5, in_place_collision_resolution = 0.1;
  bool use_collision_detection = true;

  static Description<GracefulOptions> nav2() {
    using G = GracefulOptions;
    return {
        {"max_lookahead", &G::max_lookahead, above(0, "m").usually(0.3, 2),
         "greatest distance of the target on the path"},
        {"k_phi", &G::k_phi, above(0).usually(0.5, 4), "how soon the robot comes to the line through the target"},
        {"k_delta", &G::k_delta, above(0).usually(0.5, 3), "how soon the heading follows"},
        {"beta", &G::beta, at_least(0).usually(0.05, 1), "how much curvature slows the robot down"},
        {"lambda_", &G::lambda, at_least(0).usually(1, 3),
         "how sharply it does; `lambda` in Nav2, which Python reserves"},
        {"v_linear_min", &G::v_linear_min, at_least(0, "m/s").usually(0.05, 0.3), "lowest speed"},
        {"v_linear_max", &G::v_linear_max, above(0, "m/s"), "highest speed, within the robot's limit"},
        {"v_angular_max", &G::v_angular_max, above(0, "rad/s").usually(0.5, 3),
         "highest turn rate, within the robot's limit"},
        {"v_angular_min_in_place", &G::v_angular_min_in_place, at_least(0, "rad/s"), "lowest turn rate on the spot"},
        {"slowdown_radius", &G::slowdown_radius, above(0, "m").usually(0.2, 2),
         "slow down within this distance of the target"},
        {"deceleration_max", &G::deceleration_max, above(0), "deceleration towards the target, m/s^2"},
        {"initial_rotation", &G::initial_rotation, "turn on the spot to a new path first"},
        {"initial_rotation_tolerance", &G::initial_rotation_tolerance, above(0).usually(0.3, 1.5),
         "angle to the target up to which the robot turns, radians"},
        {"prefer_final_rotation", &G::prefer_final_rotation,
         "come to the end of the path along it, and turn to the yaw there"},
        {"rotation_scaling_factor", &G::rotation_scaling_factor, above(0).usually(0.25, 1),
         "turn rate on the spot per radian and v_angular_max"},
        {"allow_backward", &G::allow_backward, "drive back to a target behind the robot"},
        {"in_place_collision_resolution", &G::in_place_collision_resolution, within(1e-4, 10),
         "largest turn on the spot between two checks of collisions, radians"},
        {"use_collision_detection", &G::use_collision_detection, "aim only at targets to which the way is free"}};
  }
  static Description<GracefulOptions> further() { return {}; }
  static Description<GracefulOptions> derived() { return {}; }
};

/// The control law for a target in the frame of the robot; `most` is the highest speed.
struct Law {
  const GracefulOptions& it;
  double most;

  double curvature(Pose target, bool back) const {
    const double away = std::hypot(target.x, target.y);
    const double sight = wrapped(std::atan2(-target.y, target.x) + (back ? std::acos(-1.0) : 0));
    const double phi = wrapped(target.yaw + sight), delta = sight;
    const double bend = it.k_phi * phi;
    return -(it.k_delta * (delta - std::atan(-bend)) + (1 + it.k_phi / (1 + bend * bend)) * std::sin(delta)) / away;
  }

  Twist command(Pose target, bool back) const {
    const double away = std::hypot(target.x, target.y);
    if (away < 1e-6) return {};
    const double k = (back ? -1 : 1) * curvature(target, back);
    double v = most / (1 + it.beta * std::pow(std::abs(k), it.lambda));
    v = std::min({v, most * away / it.slowdown_radius, std::sqrt(2 * away * it.deceleration_max)});
    v = std::clamp(v, std::min(it.v_linear_min, most), most);
    if (back) v = -v;
    const double turn = k * v, limited = std::clamp(turn, -it.v_angular_max, it.v_angular_max);
    return {turn == limited ? v : limited / k, limited};
  }
};

/// The direction of the last leg of a polyline that has a length, radians.
double direction_of_end(const std::vector<Point>& points) {
  for (std::size_t i = points.size(); i-- > 1;) {
    const Point leg = points[i] - points[i - 1];
    if (sim::length(leg) > 1e-6) return std::atan2(leg.y, leg.x);
  }
  return std::atan2(points.back().y, points.back().x);
}

class Graceful : public Controller {
 public:
  using Options = GracefulOptions;

  Graceful(const GracefulOptions& options, const RobotOptions& robot) : options_(options), by_radius_(robot.by_radius) {
    if (options.v_linear_min > options.v_linear_max) throw std::invalid_argument("v_linear_min exceeds v_linear_max");
    if (options.initial_rotation && options.allow_backward) {
      throw std::invalid_argument("initial_rotation and allow_backward exclude each other");
    }
  }

  std::optional<Twist> command(const Situation& now, const Extra&) override {
    fault_ = "";
    target_ = {};
    if (is_new(goal_, now.path)) {
      const Point end = now.path.end();
      goal_ = {end.x, end.y, now.path.yaw};
      turning_ = options_.initial_rotation;
    }
    const std::vector<Point> whole = in_frame_of(now.pose, now.path);
    const std::vector<Point> path = from_nearest(whole, now.costmap->options().width / 2);
    last_leg_ = direction_of_end(whole);
    const double away = sim::length(path.back());
    // The goal checker of the navigator judges by the same distance, so stop a little later than it is satisfied.
    if (away <= now.path.tolerance / 2) {
      if (std::isnan(now.path.yaw)) return Twist{};
      return turned(now, wrapped(now.path.yaw - now.pose.yaw));
    }
    const std::vector<Point> ahead = resampled(path, now.costmap->frame().resolution, options_.max_lookahead);
    for (std::size_t i = ahead.size(); i-- > 1;) {
      if (sim::length(ahead[i]) > options_.max_lookahead) continue;
      const Pose target = aimed(now, path, ahead, i);
      const bool back = options_.allow_backward && target.x < 0;
      const double bearing = std::atan2(target.y, target.x);
      if (turning_ && std::abs(bearing) > options_.initial_rotation_tolerance) {
        target_ = target;
        return turned(now, bearing);
      }
      const Law law{options_, std::min(options_.v_linear_max, now.path.speed)};
      if (options_.use_collision_detection && !arrives(now, law, target, back)) continue;
      target_ = target;
      turning_ = false;
      return law.command(target, back);
    }
    fault_ = "no target on the path is within reach";
    return std::nullopt;
  }

  /// `target` f8[3] in the robot's frame, and the `reason` why there is no command.
  Explanation explain() const override {
    return {{{"target", {{target_.x, target_.y, target_.yaw}, {3}}}}, {{"reason", {fault_}}}};
  }

 private:
  /// A point of the path with the direction of the path there, or at the end of the path the yaw that is prescribed.
  Pose aimed(const Situation& now, const std::vector<Point>& path, const std::vector<Point>& ahead,
             std::size_t i) const {
    const Point p = ahead[i], leg = p - ahead[i - 1];
    double yaw = sim::length(leg) > 1e-6 ? std::atan2(leg.y, leg.x) : last_leg_;
    const bool last = sim::length(p - path.back()) < 1e-9;
    if (last && !options_.prefer_final_rotation && !std::isnan(now.path.yaw))
      yaw = wrapped(now.path.yaw - now.pose.yaw);
    return {p.x, p.y, yaw};
  }

  std::optional<Twist> turned(const Situation& now, double angle) {
    const double wanted = options_.rotation_scaling_factor * std::abs(angle) * options_.v_angular_max;
    const double rate =
        std::clamp(wanted, std::min(options_.v_angular_min_in_place, options_.v_angular_max), options_.v_angular_max);
    const int steps =
        std::max(1, static_cast<int>(std::ceil(std::abs(angle) / options_.in_place_collision_resolution)));
    for (int k = 0; options_.use_collision_detection && k <= steps; ++k) {
      if (is_free(*now.costmap, {now.pose.x, now.pose.y, now.pose.yaw + angle * k / steps}, by_radius_)) continue;
      fault_ = "there is no room to turn";
      return std::nullopt;
    }
    return Twist{0, std::copysign(rate, angle)};
  }

  /// Tell whether the control law leads to a target without a collision.
  bool arrives(const Situation& now, const Law& law, Pose target, bool back) const {
    const double resolution = now.costmap->frame().resolution, step = resolution / options_.v_linear_max;
    const double cosine = std::cos(now.pose.yaw), sine = std::sin(now.pose.yaw);
    const int most = 3 * static_cast<int>(std::ceil(std::hypot(target.x, target.y) / resolution)) + 20;
    Pose at;  // in the frame in which the robot is now
    for (int k = 0; k < most; ++k) {
      const Pose place{now.pose.x + cosine * at.x - sine * at.y, now.pose.y + sine * at.x + cosine * at.y,
                       now.pose.yaw + at.yaw};
      if (!is_free(*now.costmap, place, by_radius_)) return false;
      const Point away = Point{target.x, target.y} - Point{at.x, at.y};
      if (sim::length(away) <= resolution) {
        const Pose end{now.pose.x + cosine * target.x - sine * target.y,
                       now.pose.y + sine * target.x + cosine * target.y, now.pose.yaw + target.yaw};
        return is_free(*now.costmap, end, by_radius_);
      }
      const double c = std::cos(at.yaw), s = std::sin(at.yaw);
      const Pose seen{c * away.x + s * away.y, c * away.y - s * away.x, wrapped(target.yaw - at.yaw)};
      const Twist twist = law.command(seen, back);
      at.x += twist.ahead * c * step;
      at.y += twist.ahead * s * step;
      at.yaw += twist.turn * step;
    }
    return true;  // it comes near at its lowest speed; the way was free so far
  }

  GracefulOptions options_;
  bool by_radius_;
  std::optional<Pose> goal_;
  bool turning_ = false;
  Pose target_;
  double last_leg_ = 0;
  const char* fault_ = "";
};

}  // namespace

ControllerKind graceful() {
  return controller_of<Graceful>();
}

}  // namespace mrpbench::local
