#include "mrpbench_local/dwb.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "mrpbench_local/reroute.hpp"

namespace mrpbench::local {

namespace {

/// Whether a path leads to another place than the one before.
bool is_new(const std::optional<Pose>& before, const Pose& goal) {
  if (!before || before->x != goal.x || before->y != goal.y) return true;
  return before->yaw != goal.yaw && !(std::isnan(before->yaw) && std::isnan(goal.yaw));
}

double thresholded(double speed, double threshold) {
  return std::abs(speed) < threshold ? 0 : speed;
}

/// Distance along a path, in metres, at which its direction is measured.
constexpr double kAhead = 0.3;

/// Angle in radians between the heading of a robot and its path.
double off(Pose pose, const Path& path) {
  Point at = path.first;
  double left = kAhead;
  for (const Point& next : path.rest) {
    const double length = sim::length(next - at);
    if (length >= left) {
      at = at + (next - at) * (left / length);
      break;
    }
    left -= length;
    at = next;
  }
  const Point away = at - Point{pose.x, pose.y};
  if (sim::length(away) < kAhead / 3) return 0;  // a robot that has nearly arrived need not turn
  return std::remainder(std::atan2(away.y, away.x) - pose.yaw, 2 * std::numbers::pi);
}

}  // namespace

Dwb::Dwb(const DwbOptions& options, std::vector<Weighted> critics)
    : options_(options), critics_(std::move(critics)), all_(options.motion) {
  const MotionOptions& motion = options.motion;
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(motion.sim_time > 0 && motion.linear_granularity > 0 && motion.angular_granularity > 0 &&
              motion.time_granularity > 0,
          "sim_time and granularities must be positive");
  require(motion.acc_lim_x > 0 && motion.acc_lim_theta > 0 && motion.decel_lim_x < 0 && motion.decel_lim_theta < 0,
          "acceleration limits must be positive, deceleration limits negative");
  require(motion.min_vel_x <= motion.max_vel_x && motion.max_vel_theta >= 0, "the lowest speed exceeds the highest");
  require(
      motion.vx_samples > 0 && motion.vtheta_samples > 0 && motion.vx_samples <= 1000 && motion.vtheta_samples <= 1000,
      "there must be 1 to 1000 samples of each speed");
}

std::optional<Twist> Dwb::command(double now, Pose pose, Twist twist, const Path& path, const Costmap& costmap,
                                  const Extra& extra) {
  const Frame& frame = costmap.frame();
  const Point end = path.rest.empty() ? path.first : path.rest.back();
  const Pose goal{end.x, end.y, path.yaw};
  if (is_new(goal_, goal)) {
    goal_ = goal;
    for (const Weighted& it : critics_) it.critic->reset();
    turning_ = options_.rotate_to_path > 0 && std::abs(off(pose, path)) > options_.rotate_to_path;
  }
  if (std::isnan(path.yaw) && sim::length({pose.x - end.x, pose.y - end.y}) <= frame.resolution) return Twist{};
  if (const auto turn = turn_first(pose, path, costmap)) return turn;
  path_.take(frame, {pose.x, pose.y}, path.first, path.rest, options_.pruning);
  if (!path_.empty()) path_.spread(frame);
  const Twist measured{thresholded(twist.ahead, options_.min_x_velocity_threshold),
                       thresholded(twist.turn, options_.min_theta_velocity_threshold)};
  all_.generate(pose, measured, path.speed);
  EndCells ends(frame, all_);
  const Scene scene{now, pose, measured, goal, path.tolerance, &costmap, &path_, &ends};
  score(scene, extra);
  const auto chosen = best(scene);
  const Twist command = chosen ? all_.twist(*chosen) : Twist{};
  for (const Weighted& it : critics_) it.critic->debrief(scene, command);
  if (!chosen) return std::nullopt;
  return command;
}

/// As Nav2's rotation shim does: a controller that drives while it turns would leave the path.
std::optional<Twist> Dwb::turn_first(Pose pose, const Path& path, const Costmap& costmap) {
  if (!turning_) return std::nullopt;
  const double left = off(pose, path);
  turning_ = std::abs(left) > options_.rotate_to_path / 4 && is_free(costmap, {pose.x, pose.y, pose.yaw + left}, false);
  if (!turning_) return std::nullopt;
  const double rate =
      std::min(options_.motion.max_vel_theta, std::sqrt(options_.motion.acc_lim_theta * std::abs(left)));
  return Twist{0, std::copysign(rate, left)};
}

/// Totals of all trajectories, from critics that need only their last poses.
void Dwb::score(const Scene& scene, const Extra& extra) {
  const std::size_t count = all_.size();
  total_.assign(count, 0);
  why_.assign(count, kLegal);
  dropped_.assign(count, -1);
  raw_.resize(count * critics_.size());
  fault_.assign(count, kLegal);
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    const Weighted& it = critics_[c];
    it.critic->prepare(scene);
    const std::span<double> raw(&raw_[c * count], count);
    const double scale = it.scale * it.critic->weight(scene);
    if (scale == 0) {
      std::fill(raw.begin(), raw.end(), 0);
      continue;
    }
    it.critic->score(scene, all_, raw, fault_);
    for (std::size_t i = 0; i < count; ++i) total_[i] += raw[i] * scale;
    for (std::size_t i = 0; i < count; ++i) {
      if (!fault_[i]) continue;
      if (!why_[i]) {
        why_[i] = fault_[i];
        dropped_[i] = static_cast<int>(c);
      }
      fault_[i] = kLegal;
    }
  }
  if (extra) extra(all_, total_);
}

/// Check all poses of a trajectory.
bool Dwb::passes(const Scene& scene, std::size_t i) {
  return all_.walk(i, [&](Pose pose) {
    for (std::size_t c = 0; c < critics_.size(); ++c) {
      const Weighted& it = critics_[c];
      if (it.scale == 0) continue;
      why_[i] = it.critic->check(scene, pose);
      if (!why_[i]) continue;
      dropped_[i] = static_cast<int>(c);
      return false;
    }
    return true;
  });
}

/// The trajectory with the lowest total, of equal ones the first. Trajectories that cannot win by their totals are not
/// checked pose by pose: DWB's short-circuit evaluation, applied to whole trajectories.
std::optional<std::size_t> Dwb::best(const Scene& scene) {
  order_.clear();
  std::size_t first = 0;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (why_[i] || !(total_[i] < std::numeric_limits<double>::infinity())) continue;
    if (!options_.short_circuit && !passes(scene, i)) continue;
    order_.push_back(i);
    if (total_[i] >= lowest) continue;
    lowest = total_[i];
    first = i;
  }
  if (order_.empty()) return std::nullopt;
  if (passes(scene, first)) return first;
  const auto worse = [&](std::size_t a, std::size_t b) {
    return total_[a] != total_[b] ? total_[a] > total_[b] : a > b;
  };
  std::make_heap(order_.begin(), order_.end(), worse);
  for (;;) {
    std::pop_heap(order_.begin(), order_.end(), worse);
    order_.pop_back();
    if (order_.empty()) return std::nullopt;
    if (passes(scene, order_.front())) return order_.front();
  }
}

}  // namespace mrpbench::local
