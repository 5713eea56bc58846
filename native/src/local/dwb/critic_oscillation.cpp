// A robot that has reversed must keep its direction for a while before it may reverse again.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mrpbench_local/dwb/critics.hpp"

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

struct OscillationOptions {
  double x_only_threshold = 0.05, reset_dist = 0.05, reset_angle = 0.2, reset_time = -1;

  static Description<OscillationOptions> description() {
    using O = OscillationOptions;
    return {{"x_only_threshold", &O::x_only_threshold, any("m/s"), "turning is checked only at speeds up to this"},
            {"oscillation_reset_dist", &O::reset_dist, any("m"), "distance after which all motions are allowed again"},
            {"oscillation_reset_angle", &O::reset_angle, "turn after which all motions are allowed again, radians"},
            {"oscillation_reset_time", &O::reset_time, any("s"),
             "time after which all motions are allowed again; -1 = never"}};
  }
};

class Oscillation : public Critic {
 public:
  using Options = OscillationOptions;
  explicit Oscillation(const Options& options) : options_(options) {}

  void reset() override {
    ahead_.reset();
    turn_.reset();
  }

  bool score(const Scene&, const Trajectories& all, std::span<double> raw, std::span<Reason> why) override {
    std::ranges::fill(raw, 0);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Twist twist = all.twist(i);
      if (ahead_.forbids(twist.ahead) || turn_.forbids(twist.turn)) why[i] = "Trajectory is oscillating.";
    }
    return true;
  }

  double weight(const Scene&) const override { return ahead_.reversed() || turn_.reversed() ? 1 : 0; }

  void debrief(const Scene& scene, Twist chosen) override {
    bool reversed = ahead_.update(chosen.ahead);
    if (options_.x_only_threshold < 0 || std::abs(chosen.ahead) <= options_.x_only_threshold) {
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
    if (options_.reset_dist >= 0 && sim::length(moved) > options_.reset_dist) return true;
    const double turned = std::abs(std::remainder(scene.pose.yaw - pose_.yaw, 2 * std::numbers::pi));
    if (options_.reset_angle >= 0 && turned > options_.reset_angle) return true;
    return options_.reset_time >= 0 && scene.now - time_ > options_.reset_time;
  }

  Options options_;
  Trend ahead_, turn_;
  Pose pose_;
  double time_ = 0;
};

}  // namespace

CriticKind oscillation() {
  return kind_of<Oscillation>();
}

}  // namespace mrpbench::local
