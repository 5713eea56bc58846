#include "mrpbench_sim/plane.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "mrpbench_sim/noise.hpp"

namespace mrpbench::sim {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// Metres in a period beyond which a mover does not move but is put where it is to be.
constexpr double kJump = 1;

/// The same angle within [-pi, pi).
double wrapped(double angle) {
  double rest = std::fmod(angle + std::numbers::pi, kTurn);
  if (rest < 0) rest += kTurn;
  return rest - std::numbers::pi;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

void require_sound(const std::vector<double>& radius, const std::vector<Drive>& drives, const std::vector<Pose>& poses,
                   double period, const Chance& chance) {
  require(drives.size() == poses.size() && poses.size() <= radius.size(), "each robot has a radius, drive and pose");
  require(period > 0 && std::isfinite(period), "the period must be positive");
  require(chance.slip >= 0 && chance.slip <= 0.5, "slip must be within 0 and 0.5");
  require(chance.actuation >= 0 && std::isfinite(chance.actuation), "actuation noise must not be negative");
  for (const double it : radius) require(it > 0 && std::isfinite(it), "radii must be positive");
  for (const Pose& it : poses) {
    require(somewhere({it.x, it.y}) && std::isfinite(it.yaw), "poses must be finite");
  }
  for (const Drive& it : drives) {
    require(it.limit.ahead >= 0 && it.limit.turn >= 0 && std::isfinite(it.limit.ahead) && std::isfinite(it.limit.turn),
            "limits of speed must be finite and not negative");
    require(it.acceleration.ahead > 0 && it.acceleration.turn > 0, "accelerations must be positive");
    require(it.wheel_separation > 0, "wheel separations must be positive");
  }
}

}  // namespace

Plane::Plane(std::vector<Segment> segments, std::vector<double> radius, std::vector<Drive> drives,
             std::vector<Pose> poses, double period, Chance chance)
    : drives_(std::move(drives)),
      poses_(std::move(poses)),
      driven_(poses_.size()),
      twists_(poses_.size()),
      wanted_(poses_.size()),
      slips_(poses_.size()),
      centres_(radius.size(), {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}),
      heading_(poses_.size()),
      period_(period),
      chance_(chance),
      contacts_((require_sound(radius, drives_, poses_, period, chance), std::move(segments)), radius,
                static_cast<int>(poses_.size())) {
  for (std::size_t i = 0; i < poses_.size(); ++i) centres_[i] = {poses_[i].x, poses_[i].y};
  // In a sub-step nothing moves farther than a quarter of the smallest radius, so that nothing passes through anything.
  double smallest = 1, fastest = 0;
  for (const double it : radius) smallest = std::min(smallest, it);
  stride_ = smallest / 4;
  for (const Drive& it : drives_) fastest = std::max(fastest, it.limit.ahead);
  reach_ = period * fastest;
}

void Plane::step(std::span<const Twist> commands, std::span<const Point> movers) {
  require(commands.size() == poses_.size(), "one twist for each robot");
  for (const Twist& it : commands) {
    require(std::isfinite(it.ahead) && std::isfinite(it.turn), "twists must be finite");
  }
  require(movers.empty() || movers.size() == mover_count(), "one place for each mover");
  const auto robots = static_cast<std::ptrdiff_t>(poses_.size());
  begin_.assign(centres_.begin() + robots, centres_.end());
  double farthest = reach_;
  for (std::size_t j = 0; j < movers.size(); ++j) {
    const double way = length(movers[j] - begin_[j]);
    if (way <= kJump)
      farthest = std::max(farthest, way);
    else
      begin_[j] = movers[j];
  }
  command(commands);
  touches_.clear();
  const int substeps = std::max(1, static_cast<int>(std::ceil(farthest / stride_)));
  for (int substep = 1; substep <= substeps; ++substep) {
    const double share = static_cast<double>(substep) / substeps;
    for (std::size_t j = 0; j < movers.size(); ++j) {
      centres_[poses_.size() + j] = substep == substeps ? movers[j] : begin_[j] + (movers[j] - begin_[j]) * share;
    }
    advance(period_ / substeps);
  }
  std::sort(touches_.begin(), touches_.end());
  touches_.erase(std::unique(touches_.begin(), touches_.end()), touches_.end());
  ++periods_;
}

void Plane::place(int robot, Point where) {
  require(robot >= 0 && static_cast<std::size_t>(robot) < poses_.size(), "there is no such robot");
  require(somewhere(where), "places must be finite");
  const auto at = static_cast<std::size_t>(robot);
  centres_[at] = where;
  poses_[at].x = where.x;
  poses_[at].y = where.y;
}

/// The speeds to which the drives change in this period.
void Plane::command(std::span<const Twist> commands) {
  const bool random = chance_.slip > 0 || chance_.actuation > 0;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    Twist wanted = commands[i];
    if (random) {
      Draws draws(chance_.seed, i, periods_);
      const auto [ahead, turn] = draws.normal();
      wanted = {wanted.ahead * (1 + chance_.actuation * ahead), wanted.turn * (1 + chance_.actuation * turn)};
      slips_[i].left = 2 * chance_.slip * draws.uniform();
      slips_[i].right = 2 * chance_.slip * draws.uniform();
    }
    wanted_[i] = limited(drives_[i], wanted);
  }
}

/// Drive the arcs of the mean twists, exactly, then let contacts push.
void Plane::advance(double dt) {
  before_ = centres_;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const Drive& drive = drives_[i];
    Twist mean;
    mean.ahead = accelerate(driven_[i].ahead, wanted_[i].ahead, drive.acceleration.ahead, dt);
    mean.turn = accelerate(driven_[i].turn, wanted_[i].turn, drive.acceleration.turn, dt);
    mean = slipped(drive, mean, slips_[i]);
    const double turn = mean.turn * dt, half = turn / 2;
    const double chord = mean.ahead * dt * (half == 0 ? 1.0 : std::sin(half) / half);
    const double heading = poses_[i].yaw + half;
    heading_[i] = {std::cos(heading), std::sin(heading)};
    centres_[i] = centres_[i] + heading_[i] * chord;
    poses_[i].yaw = wrapped(poses_[i].yaw + turn);
    twists_[i] = slipped(drive, driven_[i], slips_[i]);
  }
  free_ = centres_;
  contacts_.separate(before_, centres_, touches_);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    poses_[i].x = centres_[i].x;
    poses_[i].y = centres_[i].y;
    if (centres_[i] == free_[i]) continue;
    // The speed of a robot that was pushed is that of its real displacement.
    driven_[i].ahead = twists_[i].ahead = dot(centres_[i] - before_[i], heading_[i]) / dt;
  }
}

}  // namespace mrpbench::sim
