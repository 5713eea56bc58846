#include "mrpbench_local/dwb/trajectories.hpp"

#include <algorithm>
#include <array>
#include <climits>
#include <limits>
#include <tuple>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local {

namespace {

MRPBENCH_WIDE bool find_cells(std::size_t count, const double* end_x, const double* end_y, const double* heading_x,
                              const double* heading_y, double distance, Frame frame, int* x, int* y, int* close) {
  return frame.likely_cells(
      count, [&](std::size_t i) { return Point{end_x[i], end_y[i]} + Point{heading_x[i], heading_y[i]} * distance; },
      [&](std::size_t i, Cell c, unsigned unsure) {
        x[i] = c.x;
        y[i] = c.y;
        close[i] = static_cast<int>(unsure);
      });
}

/// The lowest and the highest column and row.
MRPBENCH_WIDE std::pair<Cell, Cell> box(std::size_t count, const int* x, const int* y) {
  Cell low{INT_MAX, INT_MAX}, high{INT_MIN, INT_MIN};
  for (std::size_t i = 0; i < count; ++i) {
    low = {std::min(low.x, x[i]), std::min(low.y, y[i])};
    high = {std::max(high.x, x[i]), std::max(high.y, y[i])};
  }
  return {low, high};
}

}  // namespace

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
      {"vx_samples", &M::vx_samples, within(1, 1000).usually(10, 40), "number of speeds that are sampled"},
      {"vtheta_samples", &M::vtheta_samples, within(1, 1000).usually(10, 40), "number of turn rates that are sampled"},
      {"sim_time", &M::sim_time, within(0.01, 60, "s").usually(0.8, 2.5), "duration of a trajectory"},
      {"linear_granularity", &M::linear_granularity, within(1e-4, 100, "m"), "longest step of a trajectory"},
      {"angular_granularity", &M::angular_granularity, within(1e-4, 100),
       "largest turn in a step of a trajectory, radians"},
      {"discretize_by_time", &M::discretize_by_time, "step by time_granularity instead of by way and angle"},
      {"time_granularity", &M::time_granularity, within(1e-4, 60, "s"), "longest step of a trajectory"},
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
  const double speed = std::abs(twist.ahead), rate = std::abs(twist.turn), time = options_->sim_time;
  const double wanted = options_->discretize_by_time ? time / options_->time_granularity
                                                     : std::max(speed * time / options_->linear_granularity,
                                                                rate * time / options_->angular_granularity);
  return std::max(1, -whole_below(-wanted));
}

void Trajectories::generate(const MotionOptions& options, Pose start, Twist current, double fastest) {
  options_ = &options;
  start_ = start;
  current_ = current;
  const double time = options.limited ? options.period : options.sim_time;
  const double highest = std::max(options.min_vel_x, std::min(options.max_vel_x, fastest));
  speeds_ = samples(current.ahead, options.min_vel_x, highest, options.acc_lim_x, options.decel_lim_x, time,
                    options.vx_samples);
  rates_ = samples(current.turn, -options.max_vel_theta, options.max_vel_theta, options.acc_lim_theta,
                   options.decel_lim_theta, time, options.vtheta_samples);
  least_.resize(rates_.size());
  for (std::size_t i = 0; i < rates_.size(); ++i) least_[i] = steps({0, rates_[i]});
  roll_out(!may_estimate());
}

/// Tell whether estimates of all poses are right to a nanometre.
bool Trajectories::may_estimate() const {
  const double fastest = std::max({std::abs(current_.ahead), std::abs(speeds_.front()), std::abs(speeds_.back())});
  const double turning = std::max({std::abs(current_.turn), std::abs(rates_.front()), std::abs(rates_.back())});
  return fastest * options_->sim_time < 100 && turning * options_->sim_time < Turns::kMostTurn &&
         steps_to_speeds() < Turns::kMostSteps;
}

/// The most steps that a trajectory takes to its speed.
int Trajectories::steps_to_speeds() const {
  if (options_->limited) return 0;
  const double fastest = std::max(std::abs(speeds_.front()), std::abs(speeds_.back()));
  const int most = std::max(steps({fastest, 0}), *std::ranges::max_element(least_));
  const double change = std::max(std::abs(speeds_.front() - current_.ahead), std::abs(speeds_.back() - current_.ahead));
  const double by = std::min(options_->acc_lim_x, -options_->decel_lim_x) * options_->sim_time / most;
  return change < Turns::kMostSteps * by ? whole_below(change / by) + 2 : Turns::kMostSteps;
}

void Trajectories::begin(Turns& turns, std::span<const double> rates) const {
  turns.begin(start_.yaw, options_->limited ? std::nullopt : std::optional(current_.turn), rates);
}

/// The last poses of all trajectories.
void Trajectories::roll_out(bool exact) const {
  const MotionOptions& options = *options_;
  const std::size_t columns = rates_.size();
  for (auto* it : {&ahead_, &turn_, &end_x_, &end_y_, &end_yaw_, &heading_x_, &heading_y_}) {
    it->resize(speeds_.size() * columns + Turns::kBlock);
  }
  begin(turns_, rates_);
  size_ = 0;
  exact_ = exact;
  const int changing = exact ? 0 : steps_to_speeds();
  const double slack = std::numeric_limits<float>::epsilon();
  for (const double v : speeds_) {
    const double speed = std::abs(v);
    if (options.max_speed_xy >= 0 && speed * speed > options.max_speed_xy * options.max_speed_xy + slack) continue;
    const int least = steps({v, 0});
    if (exact) {
      turns_.step(least_, least, options.sim_time, limits_turn());
    } else if (!turns_.estimate(least_, least, options.sim_time, limits_turn(), changing)) {
      return roll_out(true);
    }
    double *const x = &end_x_[size_], *const y = &end_y_[size_];
    turns_.drive(options.limited ? v : current_.ahead, v, limits_ahead(), x, y);
    for (std::size_t i = 0; i < columns; ++i) {
      x[i] += start_.x;
      y[i] += start_.y;
    }
    std::fill_n(&ahead_[size_], columns, v);
    std::ranges::copy(rates_, &turn_[size_]);
    std::copy_n(turns_.yaw(), columns, &end_yaw_[size_]);
    std::copy_n(turns_.heading_x(), columns, &heading_x_[size_]);
    std::copy_n(turns_.heading_y(), columns, &heading_y_[size_]);
    const std::size_t last = size_ + columns;
    if (speed > 0 && speed >= options.min_speed_xy) {
      size_ = last;
      continue;
    }
    for (std::size_t i = size_; i < last; ++i) {
      if (v == 0 && turn_[i] == 0) continue;
      if (speed < options.min_speed_xy && std::abs(turn_[i]) < options.min_speed_theta) continue;
      for (auto* it : {&ahead_, &turn_, &end_x_, &end_y_, &end_yaw_, &heading_x_, &heading_y_}) (*it)[size_] = (*it)[i];
      ++size_;
    }
  }
}

/// The last pose of one trajectory, to the last bit as if all were computed.
Pose Trajectories::end_of(Twist twist) const {
  const int least = steps({0, twist.turn});
  begin(turns_of_one_, {&twist.turn, 1});
  turns_of_one_.step({&least, 1}, steps({twist.ahead, 0}), options_->sim_time, limits_turn());
  double x[Turns::kBlock], y[Turns::kBlock];
  turns_of_one_.drive(options_->limited ? twist.ahead : current_.ahead, twist.ahead, limits_ahead(), x, y);
  return {x[0] + start_.x, y[0] + start_.y, turns_of_one_.yaw()[0]};
}

Pose Trajectories::at(std::size_t i, double time) const {
  const double dt = options_->sim_time / steps(twist(i));
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

std::pair<Cell, Cell> Trajectories::cells_ahead(const Frame& frame, double distance, std::vector<int>& x,
                                                std::vector<int>& y) const {
  x.resize(size_);
  y.resize(size_);
  close_.resize(size_);
  const auto find = [&] {
    return find_cells(size_, end_x_.data(), end_y_.data(), heading_x_.data(), heading_y_.data(), distance, frame,
                      x.data(), y.data(), close_.data());
  };
  bool sure = find();
  if (!sure && !exact_) {
    compute_ends();
    sure = find();
  }
  for (std::size_t i = 0; !sure && i < size_; ++i) {
    if (!close_[i]) continue;
    const Cell c = frame.cell(Point{end_x_[i], end_y_[i]} + Point{heading_x_[i], heading_y_[i]} * distance);
    x[i] = c.x;
    y[i] = c.y;
  }
  return box(size_, x.data(), y.data());
}

const EndCells::Cells& EndCells::ahead(double distance) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (found_[i].distance == distance) return found_[i];
  }
  if (count_ == found_.size()) found_.emplace_back();
  Cells& cells = found_[count_++];
  cells.distance = distance;
  std::tie(cells.low, cells.high) = all_->cells_ahead(*frame_, distance, cells.x, cells.y);
  cells.inside = frame_->holds(cells.low) && frame_->holds(cells.high);
  return cells;
}

}  // namespace mrpbench::local
