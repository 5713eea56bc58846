// Near the goal a robot first slows down; once it is slow, it only turns to the yaw of the goal.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mrpbench_local/dwb/critics.hpp"

namespace mrpbench::local {

namespace {

struct RotateToGoalOptions {
  double xy_goal_tolerance = 0.25, trans_stopped_velocity = 0.25, slowing_factor = 5, lookahead_time = -1;

  static Description<RotateToGoalOptions> description() {
    using R = RotateToGoalOptions;
    return {
        {"xy_goal_tolerance", &R::xy_goal_tolerance, above(0, "m"),
         "distance from the goal at which RotateToGoal begins, within the navigator's"},
        {"trans_stopped_velocity", &R::trans_stopped_velocity, at_least(0, "m/s"),
         "speed below which RotateToGoal only turns"},
        {"slowing_factor", &R::slowing_factor, "cost of speed near the goal"},
        {"lookahead_time", &R::lookahead_time, "compare the yaw at this time instead of at the end; -1 = at the end"}};
  }
};

class RotateToGoal : public Critic {
 public:
  using Options = RotateToGoalOptions;
  explicit RotateToGoal(const Options& options) : options_(options) {}

  void reset() override { in_window_ = rotating_ = false; }

  void prepare(const Scene& scene) override {
    if (std::isnan(scene.goal.yaw)) return reset();  // the goal has no yaw
    // A robot that stopped farther away than its navigator accepts would never arrive.
    const double tolerance = std::min(options_.xy_goal_tolerance, scene.tolerance);
    const Point away{scene.pose.x - scene.goal.x, scene.pose.y - scene.goal.y};
    in_window_ = in_window_ || sim::length(away) <= tolerance;
    rotating_ = rotating_ || (in_window_ && std::abs(scene.twist.ahead) <= options_.trans_stopped_velocity);
  }

  double weight(const Scene&) const override { return in_window_ ? 1 : 0; }

  bool score(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason> why) override {
    std::ranges::fill(raw, 0);
    all.compute_ends();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double speed = all.twist(i).ahead;
      if (rotating_) {
        if (speed != 0) {
          why[i] = "Nonrotation command near goal.";
        } else {
          raw[i] = off(scene, all, i);
        }
      } else if (speed * speed >= scene.twist.ahead * scene.twist.ahead) {
        why[i] = "Not slowing down near goal.";
      } else {
        raw[i] = speed * speed * options_.slowing_factor + off(scene, all, i);
      }
    }
    return true;
  }

 private:
  double off(const Scene& scene, const Trajectories& all, std::size_t i) const {
    const double yaw = options_.lookahead_time >= 0 ? all.at(i, options_.lookahead_time).yaw : all.end(i).yaw;
    return std::abs(std::remainder(yaw - scene.goal.yaw, 2 * std::numbers::pi));
  }

  Options options_;
  bool in_window_ = false, rotating_ = false;
};

}  // namespace

CriticKind rotate_to_goal() {
  return kind_of<RotateToGoal>();
}

}  // namespace mrpbench::local
