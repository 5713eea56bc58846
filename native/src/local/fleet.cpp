#include "mrpbench_local/fleet.hpp"

#include <limits>
#include <stdexcept>

#include "mrpbench_local/costmap/collision.hpp"

namespace mrpbench::local {

Fleet::Fleet(std::vector<Segment> walls, double reach, int threads)
    : walls_(std::make_shared<const StaticMap>(std::move(walls), reach)), team_(threads) {}

void Fleet::add(const RobotOptions& options, std::unique_ptr<Controller> controller) {
  robots_.push_back(std::make_unique<Robot>(
      Robot{Costmap(options.costmap, walls_), std::move(controller), options, -1e9, {}, false}));
}

/// Update a costmap as often as its options say.
void Fleet::refresh(Robot& robot, double now, Pose pose) {
  if (now - robot.updated < 1 / robot.options.costmap.update_frequency - 1e-6) return;
  robot.costmap.update(pose);
  robot.updated = now;
}

/// Begin to load what belongs to a robot into the cache. That of a fleet does not fit.
void Fleet::fetch(const Robot& robot) {
  for (std::size_t at = 0; at < sizeof robot; at += 64) {
    __builtin_prefetch(reinterpret_cast<const char*>(&robot) + at);
  }
}

void Fleet::see(double now, std::span<const std::int32_t> robots, std::span<const Pose> poses,
                std::span<const double> ranges, std::shared_ptr<const void> owner) {
  const std::size_t beams = robots.empty() ? 0 : ranges.size() / robots.size();
  team_.begin(robots.size(), [=, this, owner = std::move(owner)](std::size_t row) {
    Robot& robot = *robots_[static_cast<std::size_t>(robots[row])];
    const Pose& pose = poses[static_cast<std::size_t>(robots[row])];
    robot.costmap.see(pose, robot.options.sensor, ranges.subspan(row * beams, beams));
    refresh(robot, now, pose);
  });
}

void Fleet::command(double now, std::span<const Request> requests, std::span<Twist> commands,
                    const ExtraOfRobot& extra) {
  team_.finish();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto answer = [&](std::size_t i) {
    const Request& it = requests[i];
    Robot& robot = *robots_[it.robot];
    if (i + 1 < requests.size()) robots_[requests[i + 1].robot]->costmap.fetch();
    if (i + 2 < requests.size()) fetch(*robots_[requests[i + 2].robot]);
    if (!robot.controller) throw std::invalid_argument("a robot without a controller cannot be commanded");
    refresh(robot, now, it.pose);
    if (!robot.foresees) robot.forecast = {};
    robot.foresees = false;
    Extra more;
    if (extra) more = [&](const Samples& all, std::span<double> totals) { extra(it.robot, all, totals); };
    const Situation situation{now,     it.pose,        it.twist,
                              it.path, &robot.costmap, robot.forecast.size() > 0 ? &robot.forecast : nullptr};
    commands[i] = robot.controller->command(situation, more).value_or(Twist{nan, nan});
  };
  if (extra) {
    for (std::size_t i = 0; i < requests.size(); ++i) answer(i);
  } else {
    team_.share(requests.size(), answer);
  }
}

bool Fleet::is_free(std::size_t index, Pose pose) const {
  const Robot& it = robot(index);
  return local::is_free(it.costmap, pose, it.options.by_radius);
}

std::optional<std::vector<Point>> Fleet::reroute(std::size_t index, Point place, const Path& path) const {
  const Robot& it = robot(index);
  return local::reroute(it.costmap, place, path.first, path.rest, it.options.max_detour);
}

std::optional<std::vector<Point>> Fleet::approach(std::size_t index, Point place, const Path& path,
                                                  double tolerance) const {
  const Robot& it = robot(index);
  return local::approach(it.costmap, place, path.first, path.rest, it.options.max_detour, tolerance);
}

std::optional<std::vector<Point>> Fleet::plan(double now, std::size_t index, Pose pose, Point goal, double tolerance) {
  Robot& it = robot(index);
  refresh(it, now, pose);
  return local::plan(it.costmap, {pose.x, pose.y}, goal, tolerance);
}

}  // namespace mrpbench::local
