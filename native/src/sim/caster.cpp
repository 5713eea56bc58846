#include "mrpbench_sim/caster.hpp"

#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "mrpbench_sim/disc_hash.hpp"

namespace mrpbench::sim {

namespace {

/// Share of a segment's length by which it is prolonged, so that no beam slips between two that share an end.
constexpr double kSeam = 1e-9;
constexpr double kTurn = 2 * std::numbers::pi;
/// In the frame whose x axis is `facing`, a unit vector.
Point turned(Point p, Point facing) {
  return {p.x * facing.x + p.y * facing.y, p.y * facing.x - p.x * facing.y};
}

/// Buckets that keep the lists short and their number small for any range.
double bucket_size(double reach) {
  return std::max(1.0, reach / 4);
}

Lidar sound(const Lidar& lidar) {
  if (lidar.beams < 1) throw std::invalid_argument("a lidar needs a beam");
  if (!(lidar.range > 0 && std::isfinite(lidar.range))) throw std::invalid_argument("the range must be positive");
  return lidar;
}

}  // namespace

Caster::Caster(std::vector<Segment> segments, const Lidar& lidar, int threads)
    : lidar_(sound(lidar)),
      buckets_(segments, lidar.range, bucket_size(lidar.range)),
      per_radian_(lidar.beams / kTurn),
      padding_(kRoughAngle * per_radian_),
      edge_(1 + static_cast<long>(2 * padding_)),
      team_(threads) {
  for (const Segment& it : segments) walls_.push_back(wall(it));
  for (int i = 0; i < lidar.beams; ++i) {
    cosine_.push_back(std::cos(i * (kTurn / lidar.beams)));
    sine_.push_back(std::sin(i * (kTurn / lidar.beams)));
  }
}

Caster::Wall Caster::wall(const Segment& segment) const {
  const Point along = segment.end - segment.start;
  return {segment.start, along, lidar_.range * lidar_.range * dot(along, along)};
}

/// The sides of all robots where they stand.
std::vector<Caster::Wall> Caster::placed(const Outlines& outlines, std::span<const Pose> poses) const {
  std::vector<Wall> found;
  for (std::size_t robot = 0; robot + 1 < outlines.first.size(); ++robot) {
    const Pose& pose = poses[robot];
    const Point facing{std::cos(pose.yaw), std::sin(pose.yaw)}, centre{pose.x, pose.y};
    const auto at = [&](Point p) {
      return centre + Point{facing.x * p.x - facing.y * p.y, facing.y * p.x + facing.x * p.y};
    };
    for (int side = outlines.first[robot]; side < outlines.first[robot + 1]; ++side) {
      const Segment& own = outlines.sides[static_cast<std::size_t>(side)];
      found.push_back(wall({at(own.start), at(own.end)}));
    }
  }
  return found;
}

/// What all lidars of a scan see, found by the first thread that needs it.
struct Caster::Scene {
  std::once_flag found;
  std::vector<Point> centres;
  std::vector<Wall> moving, sides;
  double largest = 0;
  std::optional<DiscHash> hash;
};

void Caster::begin(std::span<const int> scanning, std::span<const Pose> poses, std::vector<Point> centres,
                   std::span<const double> radius, std::span<const Segment> leaves, const Outlines& outlines,
                   std::span<double> ranges, std::shared_ptr<const void> owner) {
  const auto scene = std::make_shared<Scene>();
  scene->centres = std::move(centres);
  team_.begin(scanning.size(), [=, this, owner = std::move(owner)](std::size_t row) {
    std::call_once(scene->found, [&] {
      for (const Segment& it : leaves) scene->moving.push_back(wall(it));
      scene->sides = placed(outlines, poses);
      for (const double it : radius) scene->largest = std::max(scene->largest, it);
      scene->hash.emplace((lidar_.range + scene->largest) / 2).build(scene->centres);
    });
    const auto& first = outlines.first;
    const auto beams = static_cast<std::size_t>(lidar_.beams);
    const int robot = scanning[row];
    const Pose& pose = poses[static_cast<std::size_t>(robot)];
    if (!somewhere({pose.x, pose.y}) || !std::isfinite(pose.yaw)) throw std::invalid_argument("poses must be finite");
    const Point facing{std::cos(pose.yaw), std::sin(pose.yaw)};
    const Point origin = Point{pose.x, pose.y} + Point{facing.x * lidar_.mount.x - facing.y * lidar_.mount.y,
                                                       facing.y * lidar_.mount.x + facing.x * lidar_.mount.y};
    // Until the end, the row holds 1 / distance, which is linear along a wall, so that the loops need no division.
    double* const nearness = ranges.data() + row * beams;
    std::fill_n(nearness, beams, 0.0);
    for (const std::int32_t wall : buckets_.near(origin)) {
      see_wall(walls_[static_cast<std::size_t>(wall)], origin, facing, nearness);
    }
    for (const Wall& it : scene->moving) see_wall(it, origin, facing, nearness);
    scene->hash->near(origin, lidar_.range + scene->largest, [&](int disc) {
      const auto at = static_cast<std::size_t>(disc);
      if (disc == robot) return;
      if (at + 1 >= first.size()) {
        see_disc(scene->centres[at] - origin, radius[at], facing, nearness);
        return;
      }
      for (int side = first[at]; side < first[at + 1]; ++side) {
        see_wall(scene->sides[static_cast<std::size_t>(side)], origin, facing, nearness);
      }
    });
    for (std::size_t i = 0; i < beams; ++i) {
      const double distance = 1 / nearness[i];
      const bool returns = distance >= lidar_.min_range && distance <= lidar_.range;
      nearness[i] = returns ? distance : std::numeric_limits<double>::infinity();
    }
  });
}

void Caster::see_wall(const Wall& wall, Point origin, Point facing, double* nearness) const {
  const Point offset = wall.start - origin;
  const double area = wall.along.x * offset.y - wall.along.y * offset.x;
  if (!(area > 0) || area * area > wall.reach) return;  // the beam comes from behind, or the wall is out of range
  const Point start = turned(offset, facing), along = turned(wall.along, facing);
  const Span span = between(start + along * (1 + kSeam), start - along * kSeam);
  const double a = along.x / area, b = along.y / area;
  const auto test = [&](std::size_t i) {
    const double turn = sine_[i] * along.x - cosine_[i] * along.y;
    const double share = cosine_[i] * start.y - sine_[i] * start.x;
    if (turn > 0 && share >= -kSeam * turn && share <= (1 + kSeam) * turn) {
      nearness[i] = std::max(nearness[i], sine_[i] * a - cosine_[i] * b);
    }
  };
  const long sides = std::min(edge_, span.count);
  for (long k = 0; k < sides; ++k) test(beam(span.first + k));
  for (long k = std::max(span.count - edge_, sides); k < span.count; ++k) test(beam(span.first + k));
  // All beams in between hit the wall.
  long left = span.count - 2 * edge_;
  if (left <= 0) return;
  std::size_t i = beam(span.first + edge_);
  while (left > 0) {
    const std::size_t stop = std::min(i + static_cast<std::size_t>(left), cosine_.size());
    left -= static_cast<long>(stop - i);
    for (; i < stop; ++i) nearness[i] = std::max(nearness[i], sine_[i] * a - cosine_[i] * b);
    i = 0;
  }
}

void Caster::see_disc(Point offset, double radius, Point facing, double* nearness) const {
  const double squared = dot(offset, offset), power = squared - radius * radius;
  if (power <= 0) {  // around the sensor
    std::fill_n(nearness, cosine_.size(), std::numeric_limits<double>::infinity());
    return;
  }
  const double reach = lidar_.range + radius;
  if (!(squared <= reach * reach)) return;
  const Point centre = turned(offset, facing);
  const double tangent = std::sqrt(power);
  const Span span = between({tangent * centre.x + radius * centre.y, tangent * centre.y - radius * centre.x},
                            {tangent * centre.x - radius * centre.y, tangent * centre.y + radius * centre.x});
  for (long k = 0; k < span.count; ++k) {
    const std::size_t i = beam(span.first + k);
    const double beside = centre.x * sine_[i] - centre.y * cosine_[i];
    const double depth = radius * radius - beside * beside;
    if (depth < 0) continue;
    // A beam enters at ahead - depth and leaves at ahead + depth, the product of which is the power of the point.
    const double ahead = centre.x * cosine_[i] + centre.y * sine_[i];
    nearness[i] = std::max(nearness[i], (ahead + std::sqrt(depth)) / power);
  }
}

/// Beams from one direction counter-clockwise to another that is less than half a turn away, and up to a few more at
/// each end.
Caster::Span Caster::between(Point right, Point left) const {
  const double from = rough_angle(right);
  double width = rough_angle(left) - from;
  if (width < -1) width += kTurn;
  const double first = std::ceil(from * per_radian_ - padding_);
  const double last = std::floor((from + width) * per_radian_ + padding_);
  return {static_cast<long>(first),
          std::clamp(static_cast<long>(last - first) + 1, 0L, static_cast<long>(lidar_.beams))};
}

std::size_t Caster::beam(long index) const {
  if (index < 0) index += lidar_.beams;
  if (index >= lidar_.beams) index -= lidar_.beams;
  return static_cast<std::size_t>(index);
}

}  // namespace mrpbench::sim
