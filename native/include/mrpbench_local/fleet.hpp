// The local controllers of a fleet: a costmap and a controller per robot, with one call for all.
#pragma once

#include <memory>

#include "mrpbench_local/controller.hpp"
#include "mrpbench_local/path/reroute.hpp"
#include "mrpbench_sim/team.hpp"

namespace mrpbench::local {

/// The input of `command` for one robot.
struct Request {
  std::size_t robot = 0;
  Pose pose;
  Twist twist;
  Path path;
};

/// Scores that the caller adds to those of the trajectories of a robot.
using ExtraOfRobot = std::function<void(std::size_t robot, const Samples&, std::span<double>)>;

class Fleet {
 public:
  /// `walls` are those of the static map; results do not depend on the number of threads.
  Fleet(std::vector<Segment> walls, double reach, int threads);
  Fleet(const Fleet&) = delete;
  Fleet& operator=(const Fleet&) = delete;

  /// Without a controller, a robot has a costmap only: it is not commanded.
  void add(const RobotOptions& options, std::unique_ptr<Controller> controller);
  std::size_t size() const { return robots_.size(); }

  /// Keep scans for the next update: row i of `ranges` is from `robots[i]`, which is at `poses[robots[i]]`. The
  /// other threads do so until any method is called; `owner` keeps what is passed until then.
  void see(double now, std::span<const std::int32_t> robots, std::span<const Pose> poses,
           std::span<const double> ranges, std::shared_ptr<const void> owner);
  /// Commands, NaN where none is admissible. `extra` is called in this thread only.
  void command(double now, std::span<const Request> requests, std::span<Twist> commands,
               const ExtraOfRobot& extra = {});

  /// What one robot predicts from now on, for the next call of `command` alone.
  void foresee(std::size_t index, Forecast forecast) {
    robot(index).forecast = std::move(forecast);
    robot(index).foresees = true;
  }

  void clear(std::size_t index) { robot(index).costmap.clear(); }
  bool is_free(std::size_t index, Pose pose) const;
  std::optional<std::vector<Point>> reroute(std::size_t index, Point place, const Path& path) const;
  std::optional<std::vector<Point>> approach(std::size_t index, Point place, const Path& path, double tolerance) const;
  /// Update the costmap if it is due, and plan on it.
  std::optional<std::vector<Point>> plan(double now, std::size_t index, Pose pose, Point goal, double tolerance);
  const Costmap& costmap(std::size_t index) const { return robot(index).costmap; }
  Explanation explain(std::size_t index) const {
    const auto& controller = robot(index).controller;
    return controller ? controller->explain() : Explanation{};
  }

 private:
  struct Robot {
    Costmap costmap;
    std::unique_ptr<Controller> controller;
    RobotOptions options;
    double updated = -1e9;
    Forecast forecast;
    bool foresees = false;
  };
  static void refresh(Robot& robot, double now, Pose pose);
  static void fetch(const Robot& robot);
  /// A robot that has seen its scans.
  Robot& robot(std::size_t index) const {
    team_.finish();
    return *robots_.at(index);
  }

  std::shared_ptr<const StaticMap> walls_;
  std::vector<std::unique_ptr<Robot>> robots_;
  mutable sim::Team team_;
};

}  // namespace mrpbench::local
