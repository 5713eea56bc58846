// All robots of a fleet on their routes: how far each has come, and what lies ahead of it.
#pragma once

#include <limits>
#include <vector>

#include "mrpbench_navigation/routes.hpp"

namespace mrpbench::navigation {

/// When a waypoint counts as reached: options of the navigator `waypoints`, by their names.
struct ArrivalRules {
  bool stops = false, stateful = true;
  bool beyond_bends = false;  // robots cut corners: waypoints before the nearest leg are passed
  double passing_tolerance = 0, yaw_goal_tolerance = 0;
  double trans_stopped_velocity = 0, rot_stopped_velocity = 0;
};

/// The progress of one robot on its route.
struct Progress {
  Index reached = 0, cleared = 0;  // leading segments completed, and those whose start the robot has left
  Index leg = 0;                   // the robot drives from this corner to the next one
  Index released = 0, end = 0;     // as far as it may go now, and the corner at which that ends
  bool halting = false;            // it has reached a waypoint to stop at, and still moves
  bool at_goal = false;            // it is at a place where it may have to turn before that counts as reached

  bool operator==(const Progress&) const = default;
};

/// What lies ahead of one robot. It follows from its progress alone.
struct Ahead {
  Leg leg;
  Index begin = 0, end = 0;  // rows of the corners of its path
  Point path_end;
  double yaw = std::numeric_limits<double>::quiet_NaN();  // to take at the end of the path, NaN = any
  double speed = std::numeric_limits<double>::infinity();
  bool uses_lift = false;     // a lift carries the robot on its next segment
  bool may_drive = false;     // something is released that it may have to drive or turn to
  bool is_finishing = false;  // it has reached all that is released, and drives on to its very end
};

/// What can change the progress of one robot while nothing more is released to it: the rows of the tables, side by
/// side, because those of a fleet do not fit the cache. It follows from its progress alone.
struct Awaited {
  Arrival arrival;
  Rounding rounding;
  Clearing clearing;
  bool may_arrive = false, may_round = false, may_clear = false;
  bool at_once = false;  // the progress may change wherever the robot is
};

class RouteFollower {
 public:
  RouteFollower(std::size_t size, const ArrivalRules& rules)
      : rules_(rules), progress_(size), ahead_(size), awaited_(size) {}

  std::size_t size() const { return progress_.size(); }

  /// Continue with routes that begin with the released parts of the old ones, but for the first `cut` segments of each.
  /// The tables must stay where they are.
  void adopt(const Routes& routes, std::span<const std::int32_t> cut);

  /// Count what a robot has reached, rounded and cleared of the leading segments `released` to it.
  void update(std::size_t robot, const Pose& pose, const Twist& twist, Index released, std::int16_t level);

  /// Let a robot continue from a point of its released route, as if it had reached all before.
  void rejoin(std::size_t robot, Point from);

  /// Count the end of a robot's path as reached.
  void skip_path_end(std::size_t robot);

  const Progress& progress(std::size_t robot) const { return progress_[robot]; }
  const Ahead& ahead(std::size_t robot) const { return ahead_[robot]; }
  const ArrivalRules& rules() const { return rules_; }
  bool any_yaw() const { return routes_.any_yaw; }

 private:
  Index corner(std::size_t robot, Index waypoint) const { return routes_.corner[routes_.first[robot] + waypoint]; }
  void count_reached(std::size_t robot, const Pose& pose, const Twist& twist, Index released, std::int16_t level);
  bool has_arrived(std::size_t robot, const Pose& pose, const Twist& twist, std::int16_t level);
  void count_passed(std::size_t robot, const Pose& pose);
  void count_up_to(std::size_t robot, Index corner);
  void count_corners(std::size_t robot, const Pose& pose);
  void count_cleared(std::size_t robot, const Pose& pose, Index released);
  bool goes_on(std::size_t robot, const Pose& pose, Index released) const;
  void look_ahead(std::size_t robot);
  void await(std::size_t robot);

  ArrivalRules rules_;
  Routes routes_;
  std::vector<Progress> progress_;
  std::vector<Ahead> ahead_;
  std::vector<Awaited> awaited_;
};

}  // namespace mrpbench::navigation
