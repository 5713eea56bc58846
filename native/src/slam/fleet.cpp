#include "mrpbench_slam/fleet.hpp"

#include <stdexcept>

namespace mrpbench::slam {

namespace {

/// Metres within which cells have numbers.
constexpr double kFarthest = 1e6;

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

bool near_enough(Pose pose) {
  return std::abs(pose.x) <= kFarthest && std::abs(pose.y) <= kFarthest && std::isfinite(pose.yaw);
}

}  // namespace

Fleet::Fleet(const std::vector<Pose>& placements, const Parameters& parameters) : max_beams_(parameters.max_beams) {
  for (const Pose& it : placements) {
    require(near_enough(it), "placements must be finite, within 1,000 km");
    mappers_.emplace_back(it, parameters);
  }
}

void Fleet::begin(std::span<const Pose> odometry) {
  check(odometry);
  for (std::size_t robot = 0; robot < mappers_.size(); ++robot) mappers_[robot].begin(odometry[robot]);
}

void Fleet::sense(const Scans& scans, std::span<const Pose> odometry, double now) {
  check(odometry);
  require(scans.lidar.range > 0 && std::isfinite(scans.lidar.range), "the range must be positive");
  const std::size_t beams = scans.robots.empty() ? 0 : scans.ranges.size() / scans.robots.size();
  for (std::size_t row = 0; row < scans.robots.size(); ++row) {
    const int robot = scans.robots[row];
    require(robot >= 0 && static_cast<std::size_t>(robot) < mappers_.size(), "there is no such robot");
    const auto index = static_cast<std::size_t>(robot);
    if (!mappers_[index].wants(now, odometry[index])) continue;
    mappers_[index].take(now, odometry[index],
                         scan_of(scans.ranges.subspan(row * beams, beams), scans.lidar, max_beams_));
  }
}

void Fleet::check(std::span<const Pose> odometry) const {
  require(odometry.size() == mappers_.size(), "one odometry pose for each robot");
  for (const Pose& it : odometry) require(near_enough(it), "odometry must be finite, within 1,000 km");
}

}  // namespace mrpbench::slam
