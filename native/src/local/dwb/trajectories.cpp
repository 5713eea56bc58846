#include "mrpbench_local/dwb/trajectories.hpp"

#include <algorithm>
#include <limits>

namespace mrpbench::local {

Description<MotionOptions> MotionOptions::description() {
  using M = MotionOptions;
  return {
      {"min_vel_x", &M::min_vel_x, any("m/s"), "lowest speed; negative = may drive back"},
      {"max_vel_x", &M::max_vel_x, above(0, "m/s"), "highest speed; by default the robot's"},
      {"max_vel_theta", &M::max_vel_theta, above(0, "rad/s"), "highest turn rate, within the robot's limit"},
      {"min_speed_xy", &M::min_speed_xy, any("m/s"),
       "samples with a lower speed must turn faster than min_speed_theta"},
      {"max_speed_xy", &M::max_speed_xy, any("m/s"), "highest speed in the plane; by default max_vel_x"},
      {"min_speed_theta", &M::min_speed_theta, any("rad/s"),
       "samples that turn slower than this must drive faster than min_speed_xy"},
      {"acc_lim_x", &M::acc_lim_x, above(0), "acceleration, m/s^2; by default the robot's"},
      {"acc_lim_theta", &M::acc_lim_theta, above(0), "acceleration, rad/s^2; by default the robot's"},
      {"decel_lim_x", &M::decel_lim_x, "deceleration, negative; by default the robot's"},
      {"decel_lim_theta", &M::decel_lim_theta, "deceleration, negative; by default the robot's"},
      {"vx_samples", &M::vx_samples, within(1, 1000), "number of speeds that are sampled"},
      {"vtheta_samples", &M::vtheta_samples, within(1, 1000), "number of turn rates that are sampled"},
      {"sim_time", &M::sim_time, above(0, "s"), "duration of a trajectory"},
      {"linear_granularity", &M::linear_granularity, above(0, "m"), "longest step of a trajectory"},
      {"angular_granularity", &M::angular_granularity, above(0), "largest turn in a step of a trajectory, radians"},
      {"discretize_by_time", &M::discretize_by_time, "step by time_granularity instead of by way and angle"},
      {"time_granularity", &M::time_granularity, above(0, "s"), "longest step of a trajectory"},
      {"include_last_point", &M::include_last_point, "count the last pose twice where scores are summed"},
      {"trajectory_generator_name", &M::limited,
       Choices<bool>{{"dwb_plugins::StandardTrajectoryGenerator", false}, {"dwb_plugins::LimitedAccelGenerator", true}},
       "accelerate to sampled velocities along the trajectory, or sample only what one period can reach"}};
}

std::vector<double> samples(double current, double lowest, double highest, double acceleration, double deceleration,
                            double time, int count) {
  const double now = std::clamp(current, lowest, highest);
  const double low = project(now, acceleration, deceleration, time, lowest);
  const double high = project(now, acceleration, deceleration, time, highest);
  if (std::abs(high - low) < 1e-5) return {low};
  const int steps = std::max(2, count) - 1;
  std::vector<double> result;
  for (int i = 0; i <= steps; ++i) {
    const double value = i == steps ? high : low + i * (high - low) / steps;
    if (!result.empty() && result.back() < 0 && value > 0) result.push_back(0);
    result.push_back(value);
  }
  return result;
}

int Trajectories::steps(Twist twist) const {
  const double speed = std::abs(twist.ahead), rate = std::abs(twist.turn), time = options_.sim_time;
  const double wanted = options_.discretize_by_time ? time / options_.time_granularity
                                                    : std::max(speed * time / options_.linear_granularity,
                                                               rate * time / options_.angular_granularity);
  return std::max(1, -whole_below(-wanted));
}

void Trajectories::generate(Pose start, Twist current, double fastest) {
  start_ = start;
  ahead_ = {std::cos(start.yaw), std::sin(start.yaw)};
  current_ = current;
  const double time = options_.limited ? options_.period : options_.sim_time;
  const double highest = std::max(options_.min_vel_x, std::min(options_.max_vel_x, fastest));
  const auto ahead = samples(current.ahead, options_.min_vel_x, highest, options_.acc_lim_x, options_.decel_lim_x, time,
                             options_.vx_samples);
  const auto turns = samples(current.turn, -options_.max_vel_theta, options_.max_vel_theta, options_.acc_lim_theta,
                             options_.decel_lim_theta, time, options_.vtheta_samples);
  size_ = 0;
  twist_.resize(ahead.size() * turns.size());
  for (auto* it : {&end_x_, &end_y_, &end_yaw_, &heading_x_, &heading_y_}) it->resize(twist_.size());
  // Nearly all samples of one turn rate have the same number of steps, so they share headings.
  turns_.resize(turns.size());
  for (std::size_t i = 0; i < turns.size(); ++i) turn(turns[i], steps({0, turns[i]}), turns_[i]);
  const double slack = std::numeric_limits<float>::epsilon();
  for (const double v : ahead) {
    const double speed = std::abs(v);
    if (options_.max_speed_xy >= 0 && speed * speed > options_.max_speed_xy * options_.max_speed_xy + slack) continue;
    const int least = steps({v, 0});
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const double w = turns[i];
      if (speed < options_.min_speed_xy && std::abs(w) < options_.min_speed_theta) continue;
      if (v == 0 && w == 0) continue;
      const bool shared = least <= turns_[i].count;
      if (!shared) turn(w, least, own_);
      roll_out({v, w}, shared ? turns_[i] : own_);
    }
  }
}

/// Once the wanted turn rate is reached, each heading is the last one turned by the same angle.
void Trajectories::turn(double rate, int count, Turn& result) const {
  const double dt = options_.sim_time / count;
  double yaw = start_.yaw, now = options_.limited ? rate : current_.turn;
  Point heading = ahead_, sum;
  result.count = count;
  result.sum.resize(static_cast<std::size_t>(count) + 1);
  result.sum[0] = sum;
  int k = 0;
  for (; k < count && now != rate; ++k) {
    now = project(now, options_.acc_lim_theta, options_.decel_lim_theta, dt, rate);
    sum = sum + heading;
    result.sum[static_cast<std::size_t>(k) + 1] = sum;
    yaw += now * dt;
    heading = {std::cos(yaw), std::sin(yaw)};
  }
  const Point by{std::cos(rate * dt), std::sin(rate * dt)};
  for (; k < count; ++k) {
    sum = sum + heading;
    result.sum[static_cast<std::size_t>(k) + 1] = sum;
    yaw += rate * dt;
    heading = {heading.x * by.x - heading.y * by.y, heading.x * by.y + heading.y * by.x};
  }
  result.last = heading;
  result.yaw = yaw;
}

void Trajectories::roll_out(Twist wanted, const Turn& turn) {
  const auto count = static_cast<std::size_t>(turn.count);
  const double dt = options_.sim_time / turn.count;
  double speed = options_.limited ? wanted.ahead : current_.ahead;
  Point moved;
  std::size_t k = 0;
  for (; k < count && speed != wanted.ahead; ++k) {
    speed = project(speed, options_.acc_lim_x, options_.decel_lim_x, dt, wanted.ahead);
    moved = moved + (turn.sum[k + 1] - turn.sum[k]) * speed;
  }
  moved = moved + (turn.sum[count] - turn.sum[k]) * wanted.ahead;
  twist_[size_] = wanted;
  end_x_[size_] = start_.x + moved.x * dt;
  end_y_[size_] = start_.y + moved.y * dt;
  end_yaw_[size_] = turn.yaw;
  heading_x_[size_] = turn.last.x;
  heading_y_[size_] = turn.last.y;
  ++size_;
}

Pose Trajectories::at(std::size_t i, double time) const {
  const double dt = options_.sim_time / steps(twist_[i]);
  Pose found = end(i);
  double now = -dt;
  walk(i, [&](Pose pose) {
    now += dt;
    if (now < time - 1e-9) return true;
    found = pose;
    return false;
  });
  return found;
}

const std::vector<Cell>& EndCells::ahead(double distance) {
  std::vector<Cell>& found = found_[distance];
  if (!found.empty()) return found;
  found.resize(all_.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Pose end = all_.end(i);
    found[i] = frame_.cell(Point{end.x, end.y} + all_.heading(i) * distance);
  }
  return found;
}

}  // namespace mrpbench::local
