#include "mrpbench_navigation/route_follower.hpp"

#include <algorithm>
#include <cmath>

namespace mrpbench::navigation {

namespace {

constexpr double standing = 0.01;  // m/s below which a robot stands still
constexpr Index legs_ahead = 6;    // among which the nearest to a robot is looked for, its own first
constexpr double search = 1.5;     // metres along the route up to which it is looked for (Nav2: half a costmap)
constexpr double nearer = 0.01;    // metres by which a leg ahead has to be nearer than the robot's own

}  // namespace

void RouteFollower::adopt(const Routes& routes, std::span<const std::int32_t> cut) {
  for (std::size_t i = 0; i < cut.size(); ++i) {
    Progress& it = progress_[i];
    it.leg = std::max<Index>(it.leg - corner(i, cut[i]), 0);
    it.reached = std::max<Index>(it.reached - cut[i], 0);
    it.cleared = std::max<Index>(it.cleared - cut[i], 0);
  }
  routes_ = routes;
  for (std::size_t i = 0; i < size(); ++i) {
    Progress& it = progress_[i];
    it.released = it.reached;
    it.end = corner(i, it.released);
    it.halting = it.at_goal = false;
    look_ahead(i);
  }
}

void RouteFollower::update(std::size_t robot, const Pose& pose, const Twist& twist, Index released,
                           std::int16_t level) {
  if (!goes_on(robot, pose, released)) return;
  const Progress before = progress_[robot];
  count_reached(robot, pose, twist, released, level);
  if (rules_.beyond_bends) count_passed(robot, pose);
  count_corners(robot, pose);
  count_cleared(robot, pose, released);
  if (progress_[robot] != before) look_ahead(robot);
}

/// Tell whether the progress of a robot may change.
bool RouteFollower::goes_on(std::size_t robot, const Pose& pose, Index released) const {
  const Progress& it = progress_[robot];
  const Awaited& next = awaited_[robot];
  const Index allowed = rules_.stops ? std::min(it.reached + 1, released) : released;
  if (next.at_once || it.halting || it.at_goal || it.released != allowed) return true;
  return (next.may_arrive && next.arrival.holds(pose.x, pose.y)) ||
         (next.may_round && next.rounding.holds(pose.x, pose.y)) ||
         (next.may_clear && next.clearing.holds(pose.x, pose.y));
}

void RouteFollower::count_reached(std::size_t robot, const Pose& pose, const Twist& twist, Index released,
                                  std::int16_t level) {
  Progress& it = progress_[robot];
  const bool moving = std::abs(twist.ahead) > standing;
  it.halting = it.halting && moving;
  while (!it.halting && it.reached < released && has_arrived(robot, pose, twist, level)) {
    ++it.reached;
    it.at_goal = false;
    it.halting = rules_.stops && moving;
  }
  it.released = rules_.stops ? std::min(it.reached + 1, released) : released;
  it.end = corner(robot, it.released);
}

bool RouteFollower::has_arrived(std::size_t robot, const Pose& pose, const Twist& twist, std::int16_t level) {
  Progress& it = progress_[robot];
  const Index goal = routes_.first[robot] + it.reached + 1;
  bool near = routes_.arrival[goal].holds(pose.x, pose.y) || routes_.is_wait[goal];
  if (level != routes_.level[goal]) return false;
  if (rules_.stops || it.reached + 1 == routes_.goal[robot]) {
    near = near || (it.at_goal && rules_.stateful);
    it.at_goal = near;
    const double error = angle_between(pose.yaw, routes_.yaw[goal]);
    near = near && (std::isnan(routes_.yaw[goal]) || error <= rules_.yaw_goal_tolerance) &&
           std::abs(twist.ahead) <= rules_.trans_stopped_velocity &&
           std::abs(twist.turn) <= rules_.rot_stopped_velocity;
  }
  return near;
}

// Waypoints before the nearest leg are passed, as Nav2 prunes a path up to its nearest pose. So a robot that has cut
// corners misses nothing. The end of the released part is never passed, nor is a lift.
void RouteFollower::count_passed(std::size_t robot, const Pose& pose) {
  Progress& it = progress_[robot];
  const Index first = routes_.first_corner[robot];
  const Index last = std::min(it.end, routes_.lift[first + it.leg]) - 1;
  double least = std::numeric_limits<double>::infinity(), own = 0;
  Index choice = it.leg;
  for (Index leg = it.leg; leg < it.leg + legs_ahead && leg <= last; ++leg) {
    const Leg way = routes_.leg(first + leg);
    const Point nearest = way.nearest(pose.x, pose.y);
    const double along = routes_.distance[first + leg] + std::hypot(nearest.x - way.x, nearest.y - way.y);
    double gap = std::hypot(pose.x - nearest.x, pose.y - nearest.y);
    if (leg == it.leg) {
      own = along;
    } else {
      gap += nearer;
    }
    if (along - own <= search && gap < least) least = gap, choice = leg;
  }
  if (choice == it.leg || least > rules_.passing_tolerance) return;
  count_up_to(robot, choice);
  it.leg = choice;
  it.at_goal = false;
}

void RouteFollower::count_up_to(std::size_t robot, Index corner) {
  Progress& it = progress_[robot];
  const auto at = routes_.corner.subspan(routes_.first[robot]);
  const auto begin = at.begin() + it.reached + 1, end = at.begin() + it.released + 1;
  if (begin < end) it.reached += std::upper_bound(begin, end, corner) - begin;
}

void RouteFollower::count_corners(std::size_t robot, const Pose& pose) {
  Progress& it = progress_[robot];
  const Index first = routes_.first_corner[robot], reached = corner(robot, it.reached);
  while (it.leg + 1 < it.end && reached > it.leg && routes_.rounding(first + it.leg).holds(pose.x, pose.y)) ++it.leg;
}

// A segment no longer than the clearance is cleared when it is reached: the robot may have to wait at its end, and the
// rules of the problem say what may stand that close. Waits are cleared with the move that ends them.
void RouteFollower::count_cleared(std::size_t robot, const Pose& pose, Index released) {
  Progress& it = progress_[robot];
  const Index furthest = std::min(released, it.reached + 1), reached = corner(robot, it.reached);
  for (; it.cleared < furthest; ++it.cleared) {
    const Index at = corner(robot, it.cleared), row = routes_.first_corner[robot] + at;
    if (at >= routes_.last_corner[robot] || reached < at) return;
    if (!(routes_.is_short[row] && reached > at) && !routes_.clearing(row).holds(pose.x, pose.y)) return;
  }
}

void RouteFollower::look_ahead(std::size_t robot) {
  const Progress& it = progress_[robot];
  const Index first = routes_.first[robot], first_corner = routes_.first_corner[robot];
  const Index here = first + it.reached, goal = first + std::min(it.reached + 1, routes_.last[robot]);
  const Index until = first + it.released;
  const bool is_open = it.reached < it.released;
  // No controller cuts a corner by more than the tolerance, or turns back before it is there.
  const Index next = std::min(std::max(routes_.corner[here], it.leg) + 1, it.end);
  const Index end = std::min(routes_.stop[first_corner + next], it.end);
  const double yaw = is_open ? routes_.yaw[until] : routes_.waiting_yaw[until];
  Ahead& ahead = ahead_[robot];
  ahead.leg = routes_.leg(first_corner + it.leg);
  ahead.begin = first_corner + std::min(it.leg + 1, end);
  ahead.end = first_corner + end + 1;
  ahead.path_end = routes_.corners[first_corner + end];
  ahead.yaw = end == it.end ? yaw : std::numeric_limits<double>::quiet_NaN();
  ahead.speed = routes_.speed[here];
  ahead.uses_lift = is_open && routes_.level[here] != routes_.level[goal];
  ahead.may_drive = !it.halting && (it.end > 0 || !std::isnan(yaw));
  ahead.is_finishing = it.leg + 1 >= it.end && !is_open;
  await(robot);
}

void RouteFollower::await(std::size_t robot) {
  const Progress& it = progress_[robot];
  const Index first_corner = routes_.first_corner[robot], reached = corner(robot, it.reached);
  Awaited next;
  next.at_once = rules_.beyond_bends;
  next.may_arrive = it.reached < it.released;
  if (next.may_arrive) {
    const Index goal = routes_.first[robot] + it.reached + 1;
    next.arrival = routes_.arrival[goal];
    next.at_once = next.at_once || routes_.is_wait[goal];
  }
  next.may_round = it.leg + 1 < it.end && reached > it.leg;
  if (next.may_round) next.rounding = routes_.rounding(first_corner + it.leg);
  if (it.cleared < std::min(it.released, it.reached + 1)) {
    const Index at = corner(robot, it.cleared);
    next.may_clear = at < routes_.last_corner[robot] && reached >= at;
    if (next.may_clear) next.clearing = routes_.clearing(first_corner + at);
    next.at_once = next.at_once || (next.may_clear && routes_.is_short[first_corner + at] && reached > at);
  }
  awaited_[robot] = next;
}

void RouteFollower::rejoin(std::size_t robot, Point from) {
  Progress& it = progress_[robot];
  const Index end = std::max(it.end, it.leg + 1);
  double least = std::numeric_limits<double>::infinity();
  Index choice = it.leg;
  for (Index leg = it.leg; leg < end; ++leg) {
    const Point nearest = routes_.leg(routes_.first_corner[robot] + leg).nearest(from.x, from.y);
    const double gap = std::hypot(from.x - nearest.x, from.y - nearest.y);
    if (gap < least) least = gap, choice = leg;
  }
  it.leg = choice;
  count_up_to(robot, choice);
  look_ahead(robot);
}

void RouteFollower::skip_path_end(std::size_t robot) {
  Progress& it = progress_[robot];
  const Index end = ahead_[robot].end - 1 - routes_.first_corner[robot];
  count_up_to(robot, end);
  it.leg = std::max(it.leg, std::min(end, routes_.last_corner[robot] - 1));
  it.at_goal = false;
  look_ahead(robot);
}

}  // namespace mrpbench::navigation
