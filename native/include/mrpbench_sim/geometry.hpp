// Points and segments of the plane, metres.
#pragma once

#include <algorithm>
#include <cmath>

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
