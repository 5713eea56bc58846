// Near the goal a robot first slows down; once it is slow, it only turns to the yaw of the goal.
#include <cmath>
#include <numbers>

#include "mrpbench_local/critics.hpp"

namespace mrpbench::local {

namespace {

class RotateToGoal : public Critic {
 public:
  explicit RotateToGoal(CriticOptions& options)
      : xy_goal_tolerance_(options.take("xy_goal_tolerance", 0.25)),
        trans_stopped_velocity_(options.take("trans_stopped_velocity", 0.25)),
        slowing_factor_(options.take("slowing_factor", 5)),
        lookahead_time_(options.take("lookahead_time", -1)) {}

  void reset() override { in_window_ = rotating_ = false; }

  void prepare(const Scene& scene) override {
    if (std::isnan(scene.goal.yaw)) return reset();  // the goal has no yaw
    // A robot that stopped farther away than its navigator accepts would never arrive.
    const double tolerance = std::min(xy_goal_tolerance_, scene.tolerance);
    const Point away{scene.pose.x - scene.goal.x, scene.pose.y - scene.goal.y};
    in_window_ = in_window_ || sim::length(away) <= tolerance;
    rotating_ = rotating_ || (in_window_ && std::abs(scene.twist.ahead) <= trans_stopped_velocity_);
  }

  void score(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason> why) override {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double speed = all.twist(i).ahead;
      raw[i] = 0;
      if (!in_window_) continue;
      if (rotating_) {
        if (speed != 0) {
          why[i] = "Nonrotation command near goal.";
        } else {
          raw[i] = off(scene, all, i);
        }
      } else if (speed * speed >= scene.twist.ahead * scene.twist.ahead) {
        why[i] = "Not slowing down near goal.";
      } else {
        raw[i] = speed * speed * slowing_factor_ + off(scene, all, i);
      }
    }
  }

 private:
  double off(const Scene& scene, const Trajectories& all, std::size_t i) const {
    const double yaw = lookahead_time_ >= 0 ? all.at(i, lookahead_time_).yaw : all.end(i).yaw;
    return std::abs(std::remainder(yaw - scene.goal.yaw, 2 * std::numbers::pi));
  }

  double xy_goal_tolerance_, trans_stopped_velocity_, slowing_factor_, lookahead_time_;
  bool in_window_ = false, rotating_ = false;
};

}  // namespace

std::unique_ptr<Critic> rotate_to_goal(CriticOptions& options) {
  return std::make_unique<RotateToGoal>(options);
}

}  // namespace mrpbench::local
