// What the robots of a fleet track, with one call for all scans of a control period.
#pragma once

#include "mrpbench_sim/team.hpp"
#include "mrpbench_tracking/predict.hpp"
#include "mrpbench_tracking/tracker.hpp"

namespace mrpbench::tracking {

/// Seconds between the places that are predicted.
constexpr double kStep = 0.1;

/// A robot of the fleet: where its lidar is, and the radius of its footprint.
struct Carrier {
  Point mount;
  double radius = 0;
};

/// Objects that move: the robot that tracks each, and its places from a time on, `kStep` apart.
struct Predicted {
  std::vector<std::int32_t> robot;
  Places places;
  std::size_t count = 0;
};

class Fleet {
 public:
  /// Results do not depend on the number of threads.
  Fleet(std::vector<Segment> walls, std::vector<Carrier> carriers, const Options& options, bool social_force,
        int threads);

  /// Take scans: row i of `ranges` is from `robots[i]`; `poses` are those of all robots. Beams that end on objects that
  /// move become -1.
  void see(double now, std::span<const std::int32_t> robots, std::span<const Pose> poses, std::span<double> ranges);

  /// The objects that move, from `now` until the horizon.
  Predicted predict(double now) const;

  std::size_t size() const { return carriers_.size(); }
  const std::vector<Track>& tracks(std::size_t robot) const { return robots_.at(robot).tracker.tracks(); }

 private:
  struct Robot {
    Tracker tracker;
    /// Of the objects that move, from the last scan on.
    Places places;
    double seen = 0;
  };

  Places foresee(const Robot& robot, std::size_t index, std::span<const Pose> poses) const;

  Map map_;
  std::vector<Carrier> carriers_;
  Options options_;
  bool social_force_;
  sim::Team team_;
  std::vector<Robot> robots_;
  std::size_t count_, kept_;
};

}  // namespace mrpbench::tracking
