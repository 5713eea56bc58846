#include "mrpbench_local/dwb/trajectories.hpp"

#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>
#include <limits>
#include <tuple>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local {

namespace {

/// `from`: where the frame lies in which ends are given.
MRPBENCH_WIDE bool find_cells(std::size_t count, const double* end_x, const double* end_y, const double* heading_x,
                              const double* heading_y, double distance, Pose from, Frame frame, int* x, int* y,
                              int* close) {
  const double cosine = std::cos(from.yaw), sine = std::sin(from.yaw);
  const auto put = [&](std::size_t i, Cell c, unsigned unsure) {
    x[i] = c.x;
    y[i] = c.y;
    close[i] = static_cast<int>(unsure);
  };
  const auto ahead = [&](std::size_t i) {
    return Point{end_x[i], end_y[i]} + Point{heading_x[i], heading_y[i]} * distance;
  };
  if (from == Pose{}) return frame.likely_cells(count, ahead, put);
  const auto placed = [&](std::size_t i) {
    const Point p = ahead(i);
    return Point{from.x + (cosine * p.x - sine * p.y), from.y + (sine * p.x + cosine * p.y)};
  };
  return frame.likely_cells(count, placed, put);
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
  highest_ = std::max(options.min_vel_x, std::min(options.max_vel_x, fastest));
  const Estimate& found = estimate();
  ends_ = &found.ends;
  if (!found.known) compute_ends();
}

/// The estimate of this state: one from before, or a new one in place of that which was not used for longest.
Trajectories::Estimate& Trajectories::estimate() {
  ++calls_;
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  for (Estimate& it : estimates_) {
    if (!same(it.current.ahead, current_.ahead) || !same(it.current.turn, current_.turn)) continue;
    if (!same(it.highest, highest_) || it.options != *options_) continue;
    it.used = calls_;
    return it;
  }
  if (estimates_.size() < kMostEstimates) estimates_.emplace_back();
  Estimate& oldest = *std::ranges::min_element(estimates_, {}, &Estimate::used);
  oldest.options = *options_;
  oldest.current = current_;
  oldest.highest = highest_;
  oldest.used = calls_;
  sample();
  oldest.known = may_estimate() && roll_out(false, {}, oldest.ends);
  return oldest;
}

void Trajectories::compute_ends() const {
  if (ends_ == &exact_) return;
  ends_ = &exact_;
  sample();
  roll_out(true, start_, exact_);
}

/// The velocities that are sampled.
void Trajectories::sample() const {
  const MotionOptions& it = *options_;
  const double time = it.limited ? it.period : it.sim_time;
  speeds_ = samples(current_.ahead, it.min_vel_x, highest_, it.acc_lim_x, it.decel_lim_x, time, it.vx_samples);
  rates_ = samples(current_.turn, -it.max_vel_theta, it.max_vel_theta, it.acc_lim_theta, it.decel_lim_theta, time,
                   it.vtheta_samples);
  least_.resize(rates_.size());
  for (std::size_t i = 0; i < rates_.size(); ++i) least_[i] = steps({0, rates_[i]});
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

void Trajectories::begin(Turns& turns, double yaw, std::span<const double> rates) const {
  turns.begin(yaw, options_->limited ? std::nullopt : std::optional(current_.turn), rates);
}

/// The last poses of all trajectories. Returns false if they cannot be estimated.
bool Trajectories::roll_out(bool exact, Pose start, Ends& ends) const {
  const MotionOptions& options = *options_;
  const std::size_t columns = rates_.size();
  for (auto* it : ends.columns()) it->resize(speeds_.size() * columns + Turns::kBlock);
  begin(turns_, start.yaw, rates_);
  std::size_t& size = ends.size = 0;
  const int changing = exact ? 0 : steps_to_speeds();
  const double slack = std::numeric_limits<float>::epsilon();
  for (const double v : speeds_) {
    const double speed = std::abs(v);
    if (options.max_speed_xy >= 0 && speed * speed > options.max_speed_xy * options.max_speed_xy + slack) continue;
    const int least = steps({v, 0});
    if (exact) {
      turns_.step(least_, least, options.sim_time, limits_turn());
    } else if (!turns_.estimate(least_, least, options.sim_time, limits_turn(), changing)) {
      return false;
    }
    double *const x = &ends.x[size], *const y = &ends.y[size];
    turns_.drive(options.limited ? v : current_.ahead, v, limits_ahead(), x, y);
    for (std::size_t i = 0; i < columns; ++i) {
      x[i] += start.x;
      y[i] += start.y;
    }
    std::fill_n(&ends.ahead[size], columns, v);
    std::ranges::copy(rates_, &ends.turn[size]);
    std::copy_n(turns_.yaw(), columns, &ends.yaw[size]);
    std::copy_n(turns_.heading_x(), columns, &ends.heading_x[size]);
    std::copy_n(turns_.heading_y(), columns, &ends.heading_y[size]);
    const std::size_t last = size + columns;
    if (speed > 0 && speed >= options.min_speed_xy) {
      size = last;
      continue;
    }
    for (std::size_t i = size; i < last; ++i) {
      if (v == 0 && ends.turn[i] == 0) continue;
      if (speed < options.min_speed_xy && std::abs(ends.turn[i]) < options.min_speed_theta) continue;
      for (auto* it : ends.columns()) (*it)[size] = (*it)[i];
      ++size;
    }
  }
  return true;
}

/// The last pose of one trajectory, to the last bit as if all were computed.
Pose Trajectories::end_of(Twist twist) const {
  const int least = steps({0, twist.turn});
  begin(turns_of_one_, start_.yaw, {&twist.turn, 1});
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
  for (auto* it : {&x, &y, &close_}) it->resize(size());
  const auto find = [&](Pose from) {
    const Ends& it = *ends_;
    return find_cells(it.size, it.x.data(), it.y.data(), it.heading_x.data(), it.heading_y.data(), distance, from,
                      frame, x.data(), y.data(), close_.data());
  };
  bool sure = ends_ != &exact_ && find(start_);
  if (!sure) {
    compute_ends();
    sure = find({});
  }
  for (std::size_t i = 0; !sure && i < size(); ++i) {
    if (!close_[i]) continue;
    const Cell c = frame.cell(Point{exact_.x[i], exact_.y[i]} + heading(i) * distance);
    x[i] = c.x;
    y[i] = c.y;
  }
  return box(size(), x.data(), y.data());
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
