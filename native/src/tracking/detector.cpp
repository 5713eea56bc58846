#include "mrpbench_tracking/detector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mrpbench::tracking {

namespace {

struct Part {
  std::vector<std::size_t> beams;
  Point low, high;  // corners of the box around all points
  Point sum;        // of the centres of its segments, each as often as it has points
};

double extent(const Part& one, const Part& other) {
  const double width = std::max(one.high.x, other.high.x) - std::min(one.low.x, other.low.x);
  const double height = std::max(one.high.y, other.high.y) - std::min(one.low.y, other.low.y);
  return std::hypot(width, height);
}

Point centre(const Part& part) {
  return part.sum * (1 / static_cast<double>(part.beams.size()));
}

void join(Part& one, const Part& other) {
  one.beams.insert(one.beams.end(), other.beams.begin(), other.beams.end());
  one.low = {std::min(one.low.x, other.low.x), std::min(one.low.y, other.low.y)};
  one.high = {std::max(one.high.x, other.high.x), std::max(one.high.y, other.high.y)};
  one.sum = one.sum + other.sum;
}

bool explained(Point p, const Map& map, std::span<const Disc> robots, const Options& options) {
  for (const std::int32_t index : map.buckets.near(p)) {
    if (length(gap(map.segments[static_cast<std::size_t>(index)], p)) <= options.wall_distance) return true;
  }
  return std::ranges::any_of(
      robots, [&](const Disc& it) { return length(p - it.centre) <= it.radius + options.robot_distance; });
}

/// A segment with a disc fitted to it.
Part fitted(std::vector<std::size_t> beams, std::span<const Point> points, Point lidar, const Options& options) {
  const Point first = points[beams.front()];
  Part part{std::move(beams), first, first, {}};
  Point mean;
  double width = 0;
  for (const std::size_t beam : part.beams) {
    const Point p = points[beam];
    part.low = {std::min(part.low.x, p.x), std::min(part.low.y, p.y)};
    part.high = {std::max(part.high.x, p.x), std::max(part.high.y, p.y)};
    mean = mean + p;
    width = std::max(width, length(p - first));
  }
  const auto count = static_cast<double>(part.beams.size());
  mean = mean * (1 / count);
  const Point away = mean - lidar;
  const double distance = length(away);
  const double behind = std::numbers::pi / 4 * std::min(options.radius, width / 2);
  if (distance > 0) mean = mean + away * (behind / distance);
  part.sum = mean * count;
  return part;
}

}  // namespace

std::vector<Detection> detect(const Scan& scan, const Map& map, std::span<const Disc> robots, const Options& options) {
  const std::size_t count = scan.ranges.size();
  const double angle = 2 * std::numbers::pi / static_cast<double>(std::max<std::size_t>(count, 1));
  const Pose at = sim::composed(scan.pose, {scan.mount.x, scan.mount.y, 0});
  const Point lidar{at.x, at.y};
  std::vector<Point> points(count);
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < count; ++i) {
    const double range = scan.ranges[i];
    if (!(range > 0) || !std::isfinite(range)) continue;
    const double yaw = at.yaw + static_cast<double>(i) * angle;
    points[i] = lidar + Point{std::cos(yaw), std::sin(yaw)} * range;
    if (!explained(points[i], map, robots, options)) ends.push_back(i);
  }
  if (ends.empty()) return {};
  const auto adjoin = [&](std::size_t one, std::size_t other) {
    const double apart = angle * std::max(scan.ranges[one], scan.ranges[other]);
    return length(points[one] - points[other]) <= options.segment_gap + apart;
  };
  std::vector<std::vector<std::size_t>> segments;
  for (const std::size_t i : ends) {
    if (!segments.empty() && adjoin(segments.back().back(), i)) {
      segments.back().push_back(i);
    } else {
      segments.push_back({i});
    }
  }
  if (segments.size() > 1 && adjoin(segments.back().back(), segments.front().front())) {
    auto& first = segments.front();
    first.insert(first.begin(), segments.back().begin(), segments.back().end());
    segments.pop_back();
  }
  std::vector<Part> parts;
  for (auto& segment : segments) {
    Part part = fitted(std::move(segment), points, lidar, options);
    if (extent(part, part) <= options.largest_object) parts.push_back(std::move(part));
  }
  while (parts.size() > 1) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t one = 0, other = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t j = i + 1; j < parts.size(); ++j) {
        const double distance = length(centre(parts[i]) - centre(parts[j]));
        if (distance >= nearest || extent(parts[i], parts[j]) > options.largest_object) continue;
        nearest = distance, one = i, other = j;
      }
    }
    if (other == 0) break;
    join(parts[one], parts[other]);
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(other));
  }
  std::vector<Detection> detections;
  for (Part& it : parts) detections.push_back({centre(it), std::move(it.beams)});
  return detections;
}

}  // namespace mrpbench::tracking
