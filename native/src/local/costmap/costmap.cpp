#include "mrpbench_local/costmap/costmap.hpp"

#include <algorithm>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "mrpbench_local/costmap/footprint.hpp"
#include "mrpbench_local/costmap/update_buffers.hpp"

namespace mrpbench::local {

namespace {

CostmapOptions sound(CostmapOptions options) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(options.resolution > 0, "the resolution of a costmap must be positive");
  const double cells = std::max(options.width, options.height) / options.resolution;
  require(cells >= 3 && cells <= 2000, "a costmap has 3 to 2000 cells along each side");
  require(options.inflation_radius >= 0 && options.inflation_radius / options.resolution <= 180,
          "the inflation radius must be within 180 cells");
  require(options.update_frequency > 0, "the update frequency must be positive");
  require(options.footprint.size() >= 3, "a footprint needs three corners");
  return options;
}

/// Cells through which a segment passes (J. Amanatides and A. Woo, "A fast voxel traversal algorithm for ray tracing",
/// Eurographics 1987).
template <class Visit>
void traverse(Point a, Point b, double resolution, Visit&& visit) {
  const double dx = (b.x - a.x) / resolution, dy = (b.y - a.y) / resolution;
  const double x = a.x / resolution, y = a.y / resolution;
  Cell at{static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))};
  const Cell last{static_cast<int>(std::floor(b.x / resolution)), static_cast<int>(std::floor(b.y / resolution))};
  const int sx = dx > 0 ? 1 : -1, sy = dy > 0 ? 1 : -1;
  const double tx = dx != 0 ? std::abs(1 / dx) : HUGE_VAL, ty = dy != 0 ? std::abs(1 / dy) : HUGE_VAL;
  double next_x = dx != 0 ? (dx > 0 ? at.x + 1 - x : x - at.x) * tx : HUGE_VAL;
  double next_y = dy != 0 ? (dy > 0 ? at.y + 1 - y : y - at.y) * ty : HUGE_VAL;
  int steps = std::abs(last.x - at.x) + std::abs(last.y - at.y);
  for (;; --steps) {
    visit(at);
    if (steps <= 0) return;
    if (next_x < next_y) {
      at.x += sx;
      next_x += tx;
    } else {
      at.y += sy;
      next_y += ty;
    }
  }
}

}  // namespace

Costmap::Costmap(CostmapOptions options, std::shared_ptr<const StaticMap> walls)
    : options_(sound(std::move(options))), walls_(std::move(walls)), inscribed_(inscribed_radius(options_.footprint)) {
  frame_.resolution = options_.resolution;
  frame_.width = static_cast<int>(std::lround(options_.width / options_.resolution));
  frame_.height = static_cast<int>(std::lround(options_.height / options_.resolution));
  marks_.begin(frame_);
  lethal_ = marks_;
  cost_.assign(frame_.size(), kFree);
  hits_.resize(frame_.size());
  room_ = inscribed_;
  // The centres of a cell and of a lethal one are a diagonal farther apart at most than points in them.
  const double apart = inscribed_ + std::numbers::sqrt2 * options_.resolution;
  const bool reaches = options_.inflation_radius >= apart + options_.resolution;
  if (options_.inflation_layer) close_ = reaches ? inflated_cost(apart, inscribed_, options_.cost_scaling_factor) : 0;
  draw_stamp();
}

void Costmap::see(Pose pose, const Sensor& sensor, std::span<const double> ranges) {
  settled_ = settled_ && pose == scan_.pose && ranges.size() == scan_.ranges.size() &&
             std::memcmp(ranges.data(), scan_.ranges.data(), ranges.size_bytes()) == 0;
  scan_.fresh = true;
  if (settled_) return;
  scan_.pose = pose;
  scan_.sensor = sensor;
  scan_.ranges.assign(ranges.begin(), ranges.end());
}

void Costmap::clear() {
  marks_.begin(frame_);
  scan_.fresh = settled_ = false;
  if (!known_) return;
  std::fill(cost_.begin(), cost_.end(), kFree);
  lethal_ = marks_;
}

void Costmap::update(Pose pose) {
  const bool stays = known_ && pose == pose_;
  if (settled_ && stays) {
    scan_.fresh = false;
    return;
  }
  settled_ = scan_.fresh || (settled_ && stays);
  roll(pose);
  pose_ = pose;
  if (options_.obstacle_layer) {
    trace();
    if (options_.footprint_clearing) clear_footprint(pose);
  }
  lethal_ = marks_;
  if (options_.static_layer) each_wall_cell([&](Cell c) { lethal_.insert(c); });
  if (options_.inflation_layer && reach_ > 0) {
    inflate();
  } else {
    std::fill(cost_.begin(), cost_.end(), kFree);
  }
  lethal_.each([&](Cell c) { cost_[frame_.index(c)] = kLethal; });
  room_ = inscribed_;
  each_nearby({pose.x, pose.y}, [&](double distance) { return room_ = std::min(room_, distance), true; });
  known_ = true;
}

/// Calls `visit(metres)` with the distance from a point to each one nearby that beams hit, and to the centre of the
/// cell of each wall nearby, until it returns false. All within the inscribed radius are nearby.
template <class Visit>
bool Costmap::each_nearby(Point p, Visit&& visit) const {
  const Point reach{inscribed_, inscribed_};
  return lethal_.each(frame_.cell(p - reach), frame_.cell(p + reach), [&](Cell c) {
    const Hit hit = marks_.holds(c) ? hits_[hit_of(c)] : Hit{};
    const Point corner = frame_.centre(c) - Point{0.5, 0.5} * frame_.resolution;
    return visit(sim::length(corner + Point{hit.x, hit.y} * frame_.resolution - p));
  });
}

bool Costmap::keeps_room(Point p) const {
  return each_nearby(p, [&](double distance) { return distance >= room_; });
}

/// Move the frame with the robot by whole cells; marks that stay inside are kept.
void Costmap::roll(Pose pose) {
  const Cell robot{static_cast<int>(std::floor(pose.x / frame_.resolution + 0.5)),
                   static_cast<int>(std::floor(pose.y / frame_.resolution + 0.5))};
  const Cell origin{robot.x - frame_.width / 2, robot.y - frame_.height / 2};
  const int dx = origin.x - frame_.origin.x, dy = origin.y - frame_.origin.y;
  if (dx == 0 && dy == 0) return;
  frame_.origin = origin;
  const auto within = [](int v, int size) { return (v % size + size) % size; };
  first_ = {within(origin.x, frame_.width), within(origin.y, frame_.height)};
  marks_.move({-dx, -dy});
}

void Costmap::draw_walls(std::vector<std::uint8_t>& cells) const {
  each_wall_cell([&](Cell c) { cells[frame_.index(c)] = kLethal; });
}

/// Calls `visit(cell)` for the cells of the frame through which outlines of the static map pass, perhaps repeatedly.
template <class Visit>
void Costmap::each_wall_cell(Visit&& visit) const {
  if (!walls_) return;
  const double left = frame_.origin.x * frame_.resolution, bottom = frame_.origin.y * frame_.resolution;
  const double right = left + frame_.width * frame_.resolution, top = bottom + frame_.height * frame_.resolution;
  for (const std::int32_t index : walls_->buckets.near({pose_.x, pose_.y})) {
    const Segment& wall = walls_->segments[static_cast<std::size_t>(index)];
    // Only the part within the frame (Y.-D. Liang and B. A. Barsky, ACM Transactions on Graphics 3, 1984).
    double from = 0, to = 1;
    const auto clip = [&](double start, double along, double low, double high) {
      if (along == 0) return start >= low && start <= high;
      const double a = (low - start) / along, b = (high - start) / along;
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
      return from <= to;
    };
    const Point along = wall.end - wall.start;
    if (!clip(wall.start.x, along.x, left, right) || !clip(wall.start.y, along.y, bottom, top)) continue;
    traverse(wall.start + along * from, wall.start + along * to, frame_.resolution, [&](Cell plane) {
      const Cell c{plane.x - frame_.origin.x, plane.y - frame_.origin.y};
      if (frame_.holds(c)) visit(c);
    });
  }
}

}  // namespace mrpbench::local
