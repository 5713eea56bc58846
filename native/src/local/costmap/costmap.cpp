#include "mrpbench_local/costmap/costmap.hpp"

#include <algorithm>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "mrpbench_local/costmap/footprint.hpp"
#include "mrpbench_local/wide.hpp"

namespace mrpbench::local {

namespace {

/// Bytes that are compared at once.
constexpr std::size_t kBlock = 16;

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

/// The first lethal cell of a row from `x` on, or its width.
std::size_t next_lethal(const std::uint8_t* row, std::size_t x, std::size_t width) {
  const void* const found = std::memchr(row + x, kLethal, width - x);
  return found ? static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - row) : width;
}

/// Raise each of `count` costs to another.
void raise(std::uint8_t* to, const std::uint8_t* from, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to[i] = std::max(to[i], from[i]);
}

}  // namespace

std::uint8_t inflated_cost(double distance, double inscribed, double cost_scaling_factor) {
  if (distance == 0) return kLethal;
  if (distance <= inscribed) return kInscribed;
  return static_cast<std::uint8_t>(252 * std::exp(-cost_scaling_factor * (distance - inscribed)));
}

Costmap::Costmap(CostmapOptions options, std::shared_ptr<const StaticMap> walls)
    : options_(sound(std::move(options))), walls_(std::move(walls)), inscribed_(inscribed_radius(options_.footprint)) {
  frame_.resolution = options_.resolution;
  frame_.width = static_cast<int>(std::lround(options_.width / options_.resolution));
  frame_.height = static_cast<int>(std::lround(options_.height / options_.resolution));
  marks_.assign(frame_.size(), kFree);
  cost_ = spare_ = marks_;
  hits_.resize(frame_.size());
  spare_hits_ = hits_;
  room_ = inscribed_;
  reach_ = static_cast<int>(std::floor(options_.inflation_radius / options_.resolution));
  const auto side = static_cast<std::size_t>(2 * reach_ + 1);
  stamp_width_ = (side + kBlock - 1) / kBlock * kBlock;
  stamp_.assign(side * stamp_width_, kFree);
  for (int y = -reach_; y <= reach_; ++y) {
    for (int x = -reach_; x <= reach_; ++x) {
      if (x * x + y * y > reach_ * reach_) continue;
      const double distance = std::sqrt(x * x + y * y) * options_.resolution;
      stamp_[static_cast<std::size_t>(y + reach_) * stamp_width_ + static_cast<std::size_t>(x + reach_)] =
          inflated_cost(distance, inscribed_, options_.cost_scaling_factor);
    }
  }
}

void Costmap::see(Pose pose, const Sensor& sensor, std::span<const double> ranges) {
  scan_.pose = pose;
  scan_.sensor = sensor;
  scan_.ranges.assign(ranges.begin(), ranges.end());
  scan_.fresh = true;
}

void Costmap::clear() {
  std::fill(marks_.begin(), marks_.end(), kFree);
  scan_.fresh = false;
  if (known_) std::fill(cost_.begin(), cost_.end(), kFree);
}

void Costmap::update(Pose pose) {
  roll(pose);
  centre_ = {pose.x, pose.y};
  if (options_.obstacle_layer) {
    trace();
    if (options_.footprint_clearing) clear_footprint(pose);
  }
  cost_ = marks_;
  if (options_.static_layer) draw_walls(cost_);
  if (options_.inflation_layer && reach_ > 0) inflate();
  room_ = clearance(centre_);
  known_ = true;
}

/// Metres from a point to the nearest one that beams hit, or to the centre of the nearest wall's cell, but not more
/// than the inscribed radius.
double Costmap::clearance(Point p) const {
  double nearest = inscribed_;
  const Point reach{inscribed_, inscribed_};
  const Cell low = frame_.cell(p - reach), high = frame_.cell(p + reach);
  for (int y = std::max(0, low.y); y <= std::min(frame_.height - 1, high.y); ++y) {
    for (int x = std::max(0, low.x); x <= std::min(frame_.width - 1, high.x); ++x) {
      const Cell c{x, y};
      const std::size_t i = frame_.index(c);
      if (cost_[i] != kLethal) continue;
      const Hit hit = marks_[i] == kLethal ? hits_[i] : Hit{};
      const Point corner = frame_.centre(c) - Point{0.5, 0.5} * frame_.resolution;
      nearest = std::min(nearest, sim::length(corner + Point{hit.x, hit.y} * frame_.resolution - p));
    }
  }
  return nearest;
}

/// Move the frame with the robot by whole cells; marks that stay inside are kept.
void Costmap::roll(Pose pose) {
  const Cell robot{static_cast<int>(std::floor(pose.x / frame_.resolution + 0.5)),
                   static_cast<int>(std::floor(pose.y / frame_.resolution + 0.5))};
  const Cell origin{robot.x - frame_.width / 2, robot.y - frame_.height / 2};
  const int dx = origin.x - frame_.origin.x, dy = origin.y - frame_.origin.y;
  if (dx == 0 && dy == 0) return;
  std::fill(spare_.begin(), spare_.end(), kFree);
  const int left = std::max(0, -dx), right = std::min(frame_.width, frame_.width - dx);
  for (int y = std::max(0, -dy); left < right && y < std::min(frame_.height, frame_.height - dy); ++y) {
    const auto from = marks_.begin() + static_cast<std::ptrdiff_t>(frame_.index({left + dx, y + dy}));
    const auto to = static_cast<std::ptrdiff_t>(frame_.index({left, y}));
    std::copy_n(from, right - left, spare_.begin() + to);
    std::copy_n(hits_.begin() + (from - marks_.begin()), right - left, spare_hits_.begin() + to);
  }
  marks_.swap(spare_);
  hits_.swap(spare_hits_);
  frame_.origin = origin;
}

/// Clear the cells along the beams, then mark the cells in which they end.
void Costmap::trace() {
  if (!scan_.fresh) return;
  scan_.fresh = false;
  const Pose& pose = scan_.pose;
  const double cosine = std::cos(pose.yaw), sine = std::sin(pose.yaw);
  const Point mount = scan_.sensor.mount;
  const Point origin{pose.x + cosine * mount.x - sine * mount.y, pose.y + sine * mount.x + cosine * mount.y};
  const Cell start = frame_.cell(origin);
  if (!frame_.holds(start)) return;
  const std::size_t beams = scan_.ranges.size();
  if (beam_.size() != beams) {
    beam_.clear();
    for (std::size_t i = 0; i < beams; ++i) {
      const double angle = static_cast<double>(i) * 2 * std::numbers::pi / static_cast<double>(beams);
      beam_.push_back({std::cos(angle), std::sin(angle)});
    }
  }
  const double left = frame_.origin.x * frame_.resolution, bottom = frame_.origin.y * frame_.resolution;
  const double right = left + frame_.width * frame_.resolution, top = bottom + frame_.height * frame_.resolution;
  const double hidden = options_.raytrace_min_range / frame_.resolution;
  const auto direction = [&](std::size_t i) {
    return Point{beam_[i].x * cosine - beam_[i].y * sine, beam_[i].x * sine + beam_[i].y * cosine};
  };
  Cell cleared = start;  // neighbouring beams often end in one cell
  for (std::size_t i = 0; options_.clearing && i < beams; ++i) {
    double range = scan_.ranges[i];
    if (!std::isfinite(range)) {
      if (!options_.inf_is_valid) continue;
      range = scan_.sensor.range;
    }
    range = std::min(range, options_.raytrace_max_range);
    const Point ahead = direction(i);
    // Up to the last cell within the frame.
    if (ahead.x > 0) range = std::min(range, (right - origin.x) / ahead.x);
    if (ahead.x < 0) range = std::min(range, (left - origin.x) / ahead.x);
    if (ahead.y > 0) range = std::min(range, (top - origin.y) / ahead.y);
    if (ahead.y < 0) range = std::min(range, (bottom - origin.y) / ahead.y);
    Cell end = frame_.cell(origin + ahead * range);
    end = {std::clamp(end.x, 0, frame_.width - 1), std::clamp(end.y, 0, frame_.height - 1)};
    if (i > 0 && end == cleared) continue;
    cleared = end;
    line(start, end, [&](Cell c) {
      const double x = c.x - start.x, y = c.y - start.y;
      if (hidden <= 0 || x * x + y * y >= hidden * hidden) marks_[frame_.index(c)] = kFree;
      return true;
    });
  }
  for (std::size_t i = 0; options_.marking && i < beams; ++i) {
    const double range = scan_.ranges[i];
    if (!(range >= options_.obstacle_min_range && range < options_.obstacle_max_range)) continue;
    const Point end = origin + direction(i) * range;
    const Cell hit = frame_.cell(end);
    if (frame_.holds(hit)) mark(hit, end);
  }
}

void Costmap::mark(Cell c, Point p) {
  const std::size_t i = frame_.index(c);
  Hit& hit = hits_[i];
  if (marks_[i] != kLethal) hit = {0, 0, 0};
  marks_[i] = kLethal;
  const Point inside = (p - frame_.centre(c)) * (1 / frame_.resolution) + Point{0.5, 0.5};
  const float share = 1.0f / static_cast<float>(++hit.beams);
  hit.x += (static_cast<float>(inside.x) - hit.x) * share;
  hit.y += (static_cast<float>(inside.y) - hit.y) * share;
}

void Costmap::clear_footprint(Pose pose) {
  place(options_.footprint, pose, corners_);
  Point low = corners_[0], high = corners_[0];
  for (const Point& p : corners_) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Cell from = frame_.cell(low), to = frame_.cell(high);
  for (int y = std::max(from.y, 0); y <= std::min(to.y, frame_.height - 1); ++y) {
    for (int x = std::max(from.x, 0); x <= std::min(to.x, frame_.width - 1); ++x) {
      if (inside(corners_, frame_.centre({x, y}))) marks_[frame_.index({x, y})] = kFree;
    }
  }
}

void Costmap::draw_walls(std::vector<std::uint8_t>& cells) const {
  if (!walls_) return;
  const double left = frame_.origin.x * frame_.resolution, bottom = frame_.origin.y * frame_.resolution;
  const double right = left + frame_.width * frame_.resolution, top = bottom + frame_.height * frame_.resolution;
  for (const std::int32_t index : walls_->buckets.near(centre_)) {
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
      if (frame_.holds(c)) cells[frame_.index(c)] = kLethal;
    });
  }
}

/// Write the costs around each lethal cell. The lethal cell that is nearest to a free one has a free side, so cells
/// without a free side can be skipped.
MRPBENCH_WIDE void Costmap::inflate() {
  const auto width = static_cast<std::size_t>(frame_.width), height = static_cast<std::size_t>(frame_.height);
  const auto reach = static_cast<std::size_t>(reach_), stride = width + 2 * reach + kBlock, side = 2 * reach + 1;
  margined_.assign(stride * (height + 2 * reach), kFree);
  const auto lethal = [&](std::size_t x, std::size_t y) { return cost_[y * width + x] == kLethal; };
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; (x = next_lethal(&cost_[y * width], x, width)) < width; ++x) {
      const bool buried = (x == 0 || lethal(x - 1, y)) && (x + 1 == width || lethal(x + 1, y)) &&
                          (y == 0 || lethal(x, y - 1)) && (y + 1 == height || lethal(x, y + 1));
      if (buried) continue;
      for (std::size_t row = 0; row < side; ++row) {
        raise(&margined_[(y + row) * stride + x], &stamp_[row * stamp_width_], stamp_width_);
      }
    }
  }
  for (std::size_t y = 0; y < height; ++y) {
    raise(&cost_[y * width], &margined_[(y + reach) * stride + reach], width);
  }
}

}  // namespace mrpbench::local
