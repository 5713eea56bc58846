#include "mrpbench_local/costmap/footprint.hpp"

#include <limits>
#include <numbers>

namespace mrpbench::local {

std::vector<Point> padded(std::span<const Point> footprint, double padding) {
  const auto away = [padding](double v) { return v > 0 ? v + padding : v < 0 ? v - padding : v; };
  std::vector<Point> result;
  for (const Point& p : footprint) result.push_back({away(p.x), away(p.y)});
  return result;
}

std::vector<Point> rounded(double radius) {
  std::vector<Point> result;
  for (int i = 0; i < 16; ++i) {
    const double angle = i * 2 * std::numbers::pi / 16;
    result.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return result;
}

double inscribed_radius(std::span<const Point> footprint) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Segment side{footprint[i], footprint[(i + 1) % footprint.size()]};
    nearest = std::min(nearest, sim::length(sim::gap(side, {0, 0})));
  }
  return nearest;
}

void place(std::span<const Point> footprint, Pose pose, std::vector<Point>& corners) {
  const double cosine = std::cos(pose.yaw), sine = std::sin(pose.yaw);
  corners.clear();
  for (const Point& p : footprint) {
    corners.push_back({pose.x + cosine * p.x - sine * p.y, pose.y + sine * p.x + cosine * p.y});
  }
}

bool inside(std::span<const Point> polygon, Point p) {
  bool odd = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point a = polygon[i], b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) odd = !odd;
  }
  return odd;
}

}  // namespace mrpbench::local
