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

  /// Keep scans for the next update: row i of `ranges` is from `robots[i]`, which is at `poses[robots[i]]`.
  void see(double now, std::span<const std::int32_t> robots, std::span<const Pose> poses,
           std::span<const double> ranges);
  /// Commands, NaN where none is admissible. `extra` is called in this thread only.
  void command(double now, std::span<const Request> requests, std::span<Twist> commands,
               const ExtraOfRobot& extra = {});

  /// What one robot predicts from now on, for the next call of `command` alone.
  void foresee(std::size_t robot, Forecast forecast) {
    robots_.at(robot)->forecast = std::move(forecast);
    robots_.at(robot)->foresees = true;
  }

  void clear(std::size_t robot) { robots_.at(robot)->costmap.clear(); }
  bool is_free(std::size_t robot, Pose pose) const;
  std::optional<std::vector<Point>> reroute(std::size_t robot, Point place, const Path& path) const;
  std::optional<std::vector<Point>> approach(std::size_t robot, Point place, const Path& path, double tolerance) const;
  /// Update the costmap if it is due, and plan on it.
  std::optional<std::vector<Point>> plan(double now, std::size_t robot, Pose pose, Point goal, double tolerance);
  const Costmap& costmap(std::size_t robot) const { return robots_.at(robot)->costmap; }
  Explanation explain(std::size_t robot) const {
    const auto& controller = robots_.at(robot)->controller;
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

  std::shared_ptr<const StaticMap> walls_;
  sim::Team team_;
  std::vector<std::unique_ptr<Robot>> robots_;
};

}  // namespace mrpbench::local
