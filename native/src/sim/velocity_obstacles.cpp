// Optimal reciprocal collision avoidance, from the paper; linear programs by the randomised incremental method without
// the random order (M. de Berg et al., "Computational Geometry", 2008, section 4.4), since constraints are few.
#include "mrpbench_sim/walkers.hpp"

namespace mrpbench::sim {

namespace {

constexpr double kLeast = 1e-10;

double cross(Point a, Point b) {
  return a.x * b.y - a.y * b.x;
}

/// By how much a velocity is outside of a half-plane; negative = inside.
double outside(const HalfPlane& plane, Point v) {
  return cross(plane.direction, plane.point - v);
}

struct Goal {
  Point wanted;
  bool direction;  // a unit vector along which to go as far as possible
};

/// The best point on the line of `planes[last]` within the circle and the planes before; false if there is none.
bool best_on_line(std::span<const HalfPlane> planes, std::size_t last, double fastest, const Goal& goal, Point& best) {
  const HalfPlane& line = planes[last];
  const double along = dot(line.point, line.direction);
  const double inside = along * along + fastest * fastest - dot(line.point, line.point);
  if (inside < 0) return false;
  double low = -along - std::sqrt(inside), high = -along + std::sqrt(inside);
  for (std::size_t i = 0; i < last; ++i) {
    const double slope = cross(line.direction, planes[i].direction);
    const double rest = cross(planes[i].direction, line.point - planes[i].point);
    if (std::abs(slope) <= kLeast) {
      if (rest < 0) return false;
      continue;
    }
    const double t = rest / slope;
    if (slope > 0)
      high = std::min(high, t);
    else
      low = std::max(low, t);
    if (low > high) return false;
  }
  const double t = goal.direction ? (dot(goal.wanted, line.direction) > 0 ? high : low)
                                  : std::clamp(dot(line.direction, goal.wanted - line.point), low, high);
  best = line.point + line.direction * t;
  return true;
}

/// The best point within the circle and all planes, or within those before the returned one.
std::size_t best_within(std::span<const HalfPlane> planes, double fastest, const Goal& goal, Point& best) {
  const double size = length(goal.wanted);
  best = goal.direction || size > fastest ? goal.wanted * (fastest / std::max(size, kLeast)) : goal.wanted;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (outside(planes[i], best) <= 0) continue;
    const Point before = best;
    if (!best_on_line(planes, i, fastest, goal, best)) {
      best = before;
      return i;
    }
  }
  return planes.size();
}

}  // namespace

HalfPlane avoiding(const Walker& me, const Walker& other, double radii, double horizon, double dt, double share) {
  const Point p = other.place - me.place, v = me.velocity - other.velocity;
  const double squared = dot(p, p);
  Point direction, u;
  const bool apart = squared > radii * radii;
  const double within = apart ? horizon : dt;
  const Point w = v - p * (1 / within);
  const double ahead = dot(w, p), size = length(w);
  if (!apart || (ahead < 0 && ahead * ahead > radii * radii * dot(w, w))) {  // the end of the cone
    const Point away = size > kLeast ? w * (1 / size) : Point{-1, 0};
    direction = {away.y, -away.x};
    u = away * (radii / within - size);
  } else {
    const double leg = std::sqrt(squared - radii * radii);
    direction = cross(p, w) > 0 ? Point{p.x * leg - p.y * radii, p.x * radii + p.y * leg} * (1 / squared)
                                : Point{p.x * leg + p.y * radii, -p.x * radii + p.y * leg} * (-1 / squared);
    u = direction * dot(v, direction) - v;
  }
  return {me.velocity + u * share, direction};
}

Point nearest_velocity(std::span<const HalfPlane> planes, std::size_t hard, double fastest, Point wanted) {
  Point best;
  const std::size_t failed = best_within(planes, fastest, {wanted, false}, best);
  double deepest = 0;
  // Where the planes contradict, the largest violation of those after the hard ones is made as small as possible.
  std::vector<HalfPlane> apart;
  for (std::size_t i = failed; i < planes.size(); ++i) {
    if (outside(planes[i], best) <= deepest) continue;
    apart.assign(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(std::min(hard, i)));
    for (std::size_t j = hard; j < i; ++j) {
      const double slope = cross(planes[i].direction, planes[j].direction);
      HalfPlane line;
      if (std::abs(slope) <= kLeast) {
        if (dot(planes[i].direction, planes[j].direction) > 0) continue;
        line.point = (planes[i].point + planes[j].point) * 0.5;
      } else {
        const double t = cross(planes[j].direction, planes[i].point - planes[j].point) / slope;
        line.point = planes[i].point + planes[i].direction * t;
      }
      const Point turned = planes[j].direction - planes[i].direction;
      line.direction = turned * (1 / std::max(length(turned), kLeast));
      apart.push_back(line);
    }
    const Point before = best;
    const Point inward{-planes[i].direction.y, planes[i].direction.x};
    if (best_within(apart, fastest, {inward, true}, best) < apart.size()) best = before;  // only by rounding
    deepest = outside(planes[i], best);
  }
  return best;
}

}  // namespace mrpbench::sim
