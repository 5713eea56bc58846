// Velocity samples within the dynamic window, and the trajectory of each (D. Fox, W. Burgard and
// S. Thrun, "The Dynamic Window Approach to Collision Avoidance", IEEE Robotics & Automation Magazine 4, 1997), by the
// rules and parameters of Nav2's DWB.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
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
  bool operator==(const MotionOptions&) const = default;
};

/// From lowest to highest, in Nav2's order, with one exact zero where they cross it.
std::vector<double> samples(double current, double lowest, double highest, double acceleration, double deceleration,
                            double time, int count);

/// All trajectories from one state. The cells of the last poses, which are needed of all, follow from estimates of
/// these poses; exact ones are computed where an estimate cannot decide, and where they are asked for. Other poses only
/// by `walk`. Estimates are in the frame of the robot, so that they serve all robots of the same options and speeds: in
/// a fleet that executes its commands exactly, most.
class Trajectories {
 public:
  Trajectories() = default;
  Trajectories(const Trajectories&) = delete;
  Trajectories& operator=(const Trajectories&) = delete;

  /// Sample and roll out; `fastest` is a further limit of speed. The options are used until the next call.
  void generate(const MotionOptions& options, Pose start, Twist current, double fastest);

  std::size_t size() const { return ends_->size; }
  Twist twist(std::size_t i) const { return {ends_->ahead[i], ends_->turn[i]}; }
  /// The last pose.
  Pose end(std::size_t i) const {
    return ends_ == &exact_ ? Pose{exact_.x[i], exact_.y[i], exact_.yaw[i]} : end_of(twist(i));
  }
  /// Compute the last poses of all, before many are asked for.
  void compute_ends() const;
  /// Unit vector along the last pose's heading, once last poses are computed.
  Point heading(std::size_t i) const { return {exact_.heading_x[i], exact_.heading_y[i]}; }
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

  /// The cells of a frame, perhaps outside of it, of the points `distance` metres ahead of the last poses. Returns the
  /// lowest and the highest column and row of them.
  std::pair<Cell, Cell> cells_ahead(const Frame& frame, double distance, std::vector<int>& x,
                                    std::vector<int>& y) const;

 private:
  /// Velocities and last poses, one row each.
  struct Ends {
    std::size_t size = 0;
    std::vector<double> ahead, turn, x, y, yaw, heading_x, heading_y;

    std::array<std::vector<double>*, 7> columns() { return {&ahead, &turn, &x, &y, &yaw, &heading_x, &heading_y}; }
  };
  /// Last poses without yaw in the frame of a robot with these speeds; nothing if they cannot be estimated.
  struct Estimate {
    MotionOptions options;
    Twist current;
    double highest = 0;
    bool known = false;
    std::uint64_t used = 0;
    Ends ends;
  };
  static constexpr std::size_t kMostEstimates = 16;

  Estimate& estimate();
  bool may_estimate() const;
  int steps_to_speeds() const;
  void sample() const;
  bool roll_out(bool exact, Pose start, Ends& ends) const;
  void begin(Turns& turns, double yaw, std::span<const double> rates) const;
  Pose end_of(Twist twist) const;
  Limits limits_ahead() const { return {options_->acc_lim_x, options_->decel_lim_x}; }
  Limits limits_turn() const { return {options_->acc_lim_theta, options_->decel_lim_theta}; }

  const MotionOptions* options_ = nullptr;
  Pose start_;
  Twist current_;
  double highest_ = 0;  // speed
  std::deque<Estimate> estimates_;
  std::uint64_t calls_ = 0;
  mutable const Ends* ends_ = &exact_;
  mutable Ends exact_;
  mutable std::vector<double> speeds_, rates_;
  mutable std::vector<int> least_;  // steps of each turn rate alone
  mutable Turns turns_, turns_of_one_;
  mutable std::vector<int> close_;
};

/// The cells that hold the ends of trajectories; computed once for all critics.
class EndCells {
 public:
  struct Cells {
    double distance = 0;
    std::vector<int> x, y;
    /// The lowest and the highest column and row.
    Cell low, high;
    /// Whether all are inside of the frame.
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

 private:
  const Frame* frame_ = nullptr;
  const Trajectories* all_ = nullptr;
  std::deque<Cells> found_;
  std::size_t count_ = 0;
};

}  // namespace mrpbench::local
