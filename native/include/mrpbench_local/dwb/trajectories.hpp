// Velocity samples within the dynamic window, and the trajectory of each (D. Fox, W. Burgard and
// S. Thrun, "The Dynamic Window Approach to Collision Avoidance", IEEE Robotics & Automation Magazine 4, 1997), by the
// rules and parameters of Nav2's DWB.
#pragma once

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "mrpbench_local/costmap/grid.hpp"
#include "mrpbench_local/dwb/turns.hpp"
#include "mrpbench_options/options.hpp"

namespace mrpbench::local {

struct MotionOptions {
  double min_vel_x = 0, max_vel_x = 0.26, max_vel_theta = 1, min_speed_xy = 0, max_speed_xy = 0.26, min_speed_theta = 0;
  double acc_lim_x = 2.5, decel_lim_x = -2.5, acc_lim_theta = 3.2, decel_lim_theta = -3.2;
  int vx_samples = 20, vtheta_samples = 20;
  double sim_time = 1.7, linear_granularity = 0.05, angular_granularity = 0.025, time_granularity = 0.5;
  bool discretize_by_time = false, include_last_point = true;
  /// Of the limited-acceleration generator: what one control period allows, kept for the whole trajectory.
  bool limited = false;
  double period = 0.05;

  static Description<MotionOptions> description();
};

/// From lowest to highest, in Nav2's order, with one exact zero where they cross it.
std::vector<double> samples(double current, double lowest, double highest, double acceleration, double deceleration,
                            double time, int count);

/// All trajectories from one state. The last poses, which are needed of nearly all, are computed at once; other poses
/// only by `walk`.
class Trajectories {
 public:
  /// Sample and roll out; `fastest` is a further limit of speed. The options are used until the next call.
  void generate(const MotionOptions& options, Pose start, Twist current, double fastest);

  std::size_t size() const { return size_; }
  Twist twist(std::size_t i) const { return {ahead_[i], turn_[i]}; }
  /// The last pose.
  Pose end(std::size_t i) const { return {end_x_[i], end_y_[i], end_yaw_[i]}; }
  /// Unit vector along the last pose's heading.
  Point heading(std::size_t i) const { return {heading_x_[i], heading_y_[i]}; }
  int steps(Twist twist) const;
  /// Seconds from the start to the last pose.
  double duration() const { return options_->sim_time; }

  /// Calls `visit(pose)` for every pose of a trajectory in order, start included, until it returns false.
  template <class Visit>
  bool walk(std::size_t i, Visit&& visit) const {
    const Twist wanted = twist(i);
    const int count = steps(wanted);
    const double dt = options_->sim_time / count;
    Pose pose = start_;
    Twist now = options_->limited ? wanted : current_;
    if (!visit(pose)) return false;
    for (int k = 0; k < count; ++k) {
      now = {project(now.ahead, options_->acc_lim_x, options_->decel_lim_x, dt, wanted.ahead),
             project(now.turn, options_->acc_lim_theta, options_->decel_lim_theta, dt, wanted.turn)};
      pose.x += now.ahead * std::cos(pose.yaw) * dt;
      pose.y += now.ahead * std::sin(pose.yaw) * dt;
      pose.yaw += now.turn * dt;
      if (!visit(pose)) return false;
    }
    return !options_->include_last_point || visit(pose);
  }

  /// The pose at `time` seconds after the start, or the last one.
  Pose at(std::size_t i, double time) const;

  /// The cells of a frame, perhaps outside of it, of the points `distance` metres ahead of the last poses. Tells
  /// whether all are inside.
  bool cells_ahead(const Frame& frame, double distance, std::vector<int>& x, std::vector<int>& y) const;

 private:
  const MotionOptions* options_ = nullptr;
  Pose start_;
  Twist current_;
  std::size_t size_ = 0;
  std::vector<double> ahead_, turn_, end_x_, end_y_, end_yaw_, heading_x_, heading_y_;
  Turns turns_;
  std::vector<int> least_;  // steps of each turn rate alone
};

/// The cells that hold the ends of trajectories; computed once for all critics.
class EndCells {
 public:
  struct Cells {
    double distance = 0;
    std::vector<int> x, y;
    bool inside = true;
  };

  /// Begin anew for other trajectories.
  void begin(const Frame& frame, const Trajectories& all) {
    frame_ = &frame;
    all_ = &all;
    count_ = 0;
  }
  /// Of the points `distance` metres ahead of the last poses.
  const Cells& ahead(double distance);
  /// The lowest and the highest column and row of the ends and of another cell.
  std::pair<Cell, Cell> box(Cell with);

 private:
  const Frame* frame_ = nullptr;
  const Trajectories* all_ = nullptr;
  std::deque<Cells> found_;
  std::size_t count_ = 0;
};

}  // namespace mrpbench::local
