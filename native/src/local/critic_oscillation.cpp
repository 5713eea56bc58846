// A robot that has reversed must keep its direction for a while before it may reverse again.
#include <cmath>
#include <numbers>

#include "mrpbench_local/critics.hpp"

namespace mrpbench::local {

namespace {

/// The direction along one axis.
class Trend {
 public:
  void reset() { *this = Trend(); }
  /// Record a speed; tells whether it reverses the direction.
  bool update(double speed) {
    bool reversed = false;
    if (speed < 0) {
      reversed = sign_ > 0;
      negative_only_ = negative_only_ || reversed;
      sign_ = -1;
    } else if (speed > 0) {
      reversed = sign_ < 0;
      positive_only_ = positive_only_ || reversed;
      sign_ = 1;
    }
    return reversed;
  }
  bool forbids(double speed) const { return (positive_only_ && speed < 0) || (negative_only_ && speed > 0); }
  bool reversed() const { return positive_only_ || negative_only_; }

 private:
  int sign_ = 0;
  bool positive_only_ = false, negative_only_ = false;
};

class Oscillation : public Critic {
 public:
  explicit Oscillation(CriticOptions& options)
      : x_only_threshold_(options.take("x_only_threshold", 0.05)),
        reset_dist_(options.take("oscillation_reset_dist", 0.05)),
        reset_angle_(options.take("oscillation_reset_angle", 0.2)),
        reset_time_(options.take("oscillation_reset_time", -1)) {}

  void reset() override {
    ahead_.reset();
    turn_.reset();
  }

  void score(const Scene&, const Trajectories& all, std::span<double> raw, std::span<Reason> why) override {
    for (std::size_t i = 0; i < all.size(); ++i) {
      raw[i] = 0;
      const Twist twist = all.twist(i);
      if (ahead_.forbids(twist.ahead) || turn_.forbids(twist.turn)) why[i] = "Trajectory is oscillating.";
    }
  }

  void debrief(const Scene& scene, Twist chosen) override {
    bool reversed = ahead_.update(chosen.ahead);
    if (x_only_threshold_ < 0 || std::abs(chosen.ahead) <= x_only_threshold_) {
      reversed = turn_.update(chosen.turn) || reversed;
    }
    if (reversed) {
      pose_ = scene.pose;
      time_ = scene.now;
    }
    if ((ahead_.reversed() || turn_.reversed()) && is_elsewhere(scene)) reset();
  }

 private:
  bool is_elsewhere(const Scene& scene) const {
    const Point moved{scene.pose.x - pose_.x, scene.pose.y - pose_.y};
    if (reset_dist_ >= 0 && sim::length(moved) > reset_dist_) return true;
    const double turned = std::abs(std::remainder(scene.pose.yaw - pose_.yaw, 2 * std::numbers::pi));
    if (reset_angle_ >= 0 && turned > reset_angle_) return true;
    return reset_time_ >= 0 && scene.now - time_ > reset_time_;
  }

  double x_only_threshold_, reset_dist_, reset_angle_, reset_time_;
  Trend ahead_, turn_;
  Pose pose_;
  double time_ = 0;
};

}  // namespace

std::unique_ptr<Critic> oscillation(CriticOptions& options) {
  return std::make_unique<Oscillation>(options);
}

}  // namespace mrpbench::local
