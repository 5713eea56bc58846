#include "mrpbench_local/path/path.hpp"

#include <algorithm>
#include <numbers>

namespace mrpbench::local {

bool is_new(const std::optional<Pose>& goal, const Path& path) {
  const Point end = path.end();
  if (!goal || goal->x != end.x || goal->y != end.y) return true;
  return goal->yaw != path.yaw && !(std::isnan(goal->yaw) && std::isnan(path.yaw));
}

std::vector<Point> in_frame_of(Pose robot, const Path& path) {
  const double cosine = std::cos(robot.yaw), sine = std::sin(robot.yaw);
  std::vector<Point> points;
  points.reserve(path.rest.size() + 1);
  const auto add = [&](Point p) {
    const Point away = p - Point{robot.x, robot.y};
    points.push_back({cosine * away.x + sine * away.y, cosine * away.y - sine * away.x});
  };
  add(path.first);
  for (const Point& p : path.rest) add(p);
  return points;
}

std::vector<Point> from_nearest(std::span<const Point> points, double search) {
  std::size_t leg = 1;
  Point nearest = points.front();
  double passed = 0, least = sim::length(nearest);
  for (std::size_t i = 1; i < points.size() && passed < search; ++i) {
    const Point p = sim::gap({points[i - 1], points[i]}, {0, 0}) * -1;
    if (sim::length(p) < least) {
      least = sim::length(p);
      nearest = p;
      leg = i;
    }
    passed += sim::length(points[i] - points[i - 1]);
  }
  std::vector<Point> rest{nearest};
  rest.insert(rest.end(), points.begin() + static_cast<std::ptrdiff_t>(std::min(leg, points.size())), points.end());
  return rest;
}

double length_of(std::span<const Point> points) {
  double total = 0;
  for (std::size_t i = 1; i < points.size(); ++i) total += sim::length(points[i] - points[i - 1]);
  return total;
}

Point point_at(std::span<const Point> points, double distance, bool straight_on) {
  Point along;  // the last leg that has a length, per metre
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point leg = points[i] - points[i - 1];
    const double length = sim::length(leg);
    if (length >= distance && length > 0) return points[i - 1] + leg * (distance / length);
    distance -= length;
    if (length > 0) along = leg * (1 / length);
  }
  return straight_on ? points.back() + along * distance : points.back();
}

std::vector<Point> resampled(std::span<const Point> points, double spacing, double length) {
  std::vector<Point> found{points.front()};
  double next = spacing, passed = 0;  // metres along the polyline
  const double slack = spacing * 1e-6;
  for (std::size_t i = 1; i < points.size() && next <= length + slack; ++i) {
    const Point leg = points[i] - points[i - 1];
    const double size = sim::length(leg);
    for (; next <= passed + size && next <= length + slack; next += spacing) {
      found.push_back(points[i - 1] + leg * ((next - passed) / size));
    }
    passed += size;
  }
  if (passed <= length && passed - (next - spacing) > slack) found.push_back(points.back());
  if (found.size() < 2) found.push_back(points.back());
  return found;
}

double wrapped(double angle) {
  return std::remainder(angle, 2 * std::numbers::pi);
}

}  // namespace mrpbench::local
