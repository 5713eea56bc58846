// What the navigator `waypoints` needs to know of a fleet in one control period, in one pass over the robots.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_navigation/progress_checker.hpp"
#include "mrpbench_navigation/route_follower.hpp"

namespace mrpbench::navigation {

/// When robots ask for detours.
struct DetourRules {
  Index every = 0;      // control periods between two requests of the same robot; 0 = robots never ask
  bool always = false;  // robots ask while they drive, too
};

/// Robots that are not driven along their routes, by what they do, and those on a detour.
struct Activities {
  std::span<const bool> aborted, recovering, rotating, detouring;
};

/// Arrays of the fleet, which `Survey` fills in each control period.
struct FleetState {
  std::vector<std::int32_t> reached, cleared;
  std::vector<Point> foot;  // the nearest point of each robot's leg
  std::vector<Index> begin, end;
  std::vector<double> yaw, speed;
  std::vector<unsigned char> under_way, following, stuck;  // they have to drive on; a controller drives them
};

/// The same of the robots that a controller drives, one row each.
struct Rows {
  std::vector<Index> robot, begin, end;
  std::vector<Pose> pose;
  std::vector<Twist> twist;
  std::vector<Point> foot;
  std::vector<double> yaw, speed;
};

class Survey {
 public:
  Survey(std::size_t robots, const ArrivalRules& arrival, const ProgressRules& progress, const DetourRules& detours);

  /// Count what all robots have reached and cleared; true if anything has changed.
  bool update(std::span<const Pose> poses, std::span<const Twist> twists, std::span<const std::int32_t> released,
              std::span<const std::int16_t> levels);

  /// Fill `state`, `rows`, `due` and `blocked`; true if a robot is stuck. `limits` in m/s may be empty.
  bool survey(double now, std::span<const Pose> poses, std::span<const Twist> twists, std::span<const double> limits,
              const Activities& activities);

  /// Copy the progress of all robots into `state`.
  void read_progress();

  /// Let a robot ask for a detour at once.
  void hurry(std::size_t robot) { requests_[robot].due = 0; }

  RouteFollower follower;
  FleetState state;
  Rows rows;
  std::size_t row_count = 0;
  std::vector<Index> due, blocked;  // rows whose turn it is to ask for a detour, and those of them that are blocked

 private:
  struct Request {
    Index due = 0;  // the control period from which on the robot may ask again
    Point place{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  };

  void add_row(std::size_t robot, const Pose& pose, const Twist& twist, double speed, bool detouring);

  ProgressChecker checker_;
  DetourRules detours_;
  std::vector<Request> requests_;
  std::vector<std::int32_t> released_;
  Index step_ = 0;
};

}  // namespace mrpbench::navigation
