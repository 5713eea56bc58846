// Points and segments of the plane, metres.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrpbench::sim {

struct Point {
  double x = 0, y = 0;
  bool operator==(const Point&) const = default;
};

inline Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y};
}
inline Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
inline Point operator*(Point a, double factor) {
  return {a.x * factor, a.y * factor};
}
inline double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}
inline double length(Point a) {
  return std::sqrt(dot(a, a));
}

/// Radians by which `rough_angle` may be wrong, rounded up.
constexpr double kRoughAngle = 2e-5;

/// The approximate angle of a direction (M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions, 4.4.49).
inline double rough_angle(Point p) {
  const double x = std::abs(p.x), y = std::abs(p.y), larger = std::max(x, y);
  const double q = larger > 0 ? std::min(x, y) / larger : 0.0, s = q * q;
  double angle = q * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))));
  angle = y > x ? std::numbers::pi / 2 - angle : angle;
  angle = p.x < 0 ? std::numbers::pi - angle : angle;
  return p.y < 0 ? -angle : angle;
}

/// A piece of the outline of something solid, which is on its left.
struct Segment {
  Point start, end;
};

/// From the nearest point of a segment to `point`.
inline Point gap(const Segment& segment, Point point) {
  const Point along = segment.end - segment.start, offset = point - segment.start;
  const double squared = dot(along, along);
  const double share = squared > 0 ? std::clamp(dot(offset, along) / squared, 0.0, 1.0) : 0.0;
  return offset - along * share;
}

}  // namespace mrpbench::sim
