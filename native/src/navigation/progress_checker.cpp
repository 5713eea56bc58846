#include "mrpbench_navigation/progress_checker.hpp"

#include <algorithm>
#include <cmath>

namespace mrpbench::navigation {

ProgressChecker::ProgressChecker(std::size_t robots, const ProgressRules& rules)
    : rules_(rules), slow_(2.001 * rules.required_movement_radius / rules.movement_time_allowance), robots_(robots) {}

void ProgressChecker::begin(double now) {
  before_ = now_;
  now_ = now;
}

bool ProgressChecker::is_stuck(std::size_t robot, const Pose& pose, bool under_way, double speed) {
  Robot& it = robots_[robot];
  const double radius = rules_.required_movement_radius, allowance = rules_.movement_time_allowance;
  if (under_way && !it.was_under_way) it.place = it.before, it.since = before_;
  it.was_under_way = under_way;
  it.before = pose;
  const double dx = pose.x - it.place.x, dy = pose.y - it.place.y;
  bool moved = dx * dx + dy * dy > radius * radius;
  if (!moved && std::isfinite(rules_.required_movement_angle)) {
    moved = angle_between(pose.yaw, it.place.yaw) > rules_.required_movement_angle;
  }
  if (speed < slow_) it.since += (now_ - before_) * (1 - std::min(1.0, speed * allowance / (2 * radius)));
  const bool stuck = under_way && !moved && now_ - it.since > allowance;
  if (under_way && (moved || stuck)) it.place = pose, it.since = now_;
  return stuck;
}

}  // namespace mrpbench::navigation
