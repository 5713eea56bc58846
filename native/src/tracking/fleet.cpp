#include "mrpbench_tracking/fleet.hpp"

#include <cmath>

namespace mrpbench::tracking {

namespace {

constexpr double kStale = 1;    // seconds after a scan in which predictions from it still reach the horizon
constexpr double kNearby = 12;  // metres within which walls and robots matter for what a robot predicts

}  // namespace

Fleet::Fleet(std::vector<Segment> walls, std::vector<Carrier> carriers, const Options& options, bool social_force,
             int threads)
    : map_(std::move(walls), options.wall_distance),
      carriers_(std::move(carriers)),
      options_(options),
      social_force_(social_force),
      team_(threads),
      robots_(carriers_.size()),
      count_(static_cast<std::size_t>(std::ceil(options.horizon / kStep - 1e-9)) + 1),
      kept_(count_ + static_cast<std::size_t>(kStale / kStep)) {}

void Fleet::see(double now, std::span<const std::int32_t> robots, std::span<const Pose> poses,
                std::span<double> ranges) {
  const std::size_t beams = robots.empty() ? 0 : ranges.size() / robots.size();
  team_.share(robots.size(), [&](std::size_t row) {
    const auto index = static_cast<std::size_t>(robots[row]);
    Robot& robot = robots_[index];
    const std::span<double> mine = ranges.subspan(row * beams, beams);
    std::vector<Disc> others;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i != index) others.push_back({{poses[i].x, poses[i].y}, carriers_[i].radius});
    }
    const auto detections = detect({poses[index], carriers_[index].mount, mine}, map_, others, options_);
    const auto track_of = robot.tracker.update(now, detections, options_);
    for (std::size_t d = 0; d < detections.size(); ++d) {
      if (!moves(robot.tracker.tracks()[track_of[d]], options_)) continue;
      for (const std::size_t beam : detections[d].beams) mine[beam] = -1;
    }
    robot.seen = now;
    robot.places = foresee(robot, index, poses);
  });
}

Places Fleet::foresee(const Robot& robot, std::size_t index, std::span<const Pose> poses) const {
  std::vector<Walker> objects;
  for (const Track& it : robot.tracker.tracks()) {
    if (moves(it, options_)) objects.push_back({it.place, it.velocity});
  }
  if (!social_force_ || objects.empty()) return by_constant_velocity(objects, kStep, kept_);
  const Point here{poses[index].x, poses[index].y};
  std::vector<Segment> walls;
  for (const Segment& it : map_.segments) {
    if (length(gap(it, here)) <= kNearby) walls.push_back(it);
  }
  std::vector<Point> robots;
  std::vector<double> radius;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (length(Point{poses[i].x, poses[i].y} - here) > kNearby) continue;
    robots.push_back({poses[i].x, poses[i].y});
    radius.push_back(carriers_[i].radius);
  }
  return by_social_force(objects, options_.radius, walls, robots, radius, kStep, kept_);
}

Predicted Fleet::predict(double now) const {
  Predicted predicted;
  predicted.count = count_;
  for (std::size_t index = 0; index < robots_.size(); ++index) {
    const Robot& it = robots_[index];
    const double later = (now - it.seen) / kStep;
    if (it.places.empty() || now - it.seen > options_.lost_after || later < 0) continue;
    for (std::size_t first = 0; first < it.places.size(); first += kept_) {
      predicted.robot.push_back(static_cast<std::int32_t>(index));
      for (std::size_t k = 0; k < count_; ++k) {
        const double at = std::min(later + static_cast<double>(k), static_cast<double>(kept_ - 1));
        const auto before = std::min(static_cast<std::size_t>(at), kept_ - 2);
        const double share = at - static_cast<double>(before);
        const Point* const place = &it.places[first + before];
        predicted.places.push_back(place[0] * (1 - share) + place[1] * share);
      }
    }
  }
  return predicted;
}

}  // namespace mrpbench::tracking
