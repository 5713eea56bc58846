#include "mrpbench_local/costmap/beams.hpp"

#include <algorithm>
#include <numbers>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

MRPBENCH_WIDE void turn(std::size_t count, const double* x, const double* y, Point by, double* to_x, double* to_y) {
  for (std::size_t i = 0; i < count; ++i) {
    const double turned_x = x[i] * by.x - y[i] * by.y, turned_y = x[i] * by.y + y[i] * by.x;
    to_x[i] = turned_x;
    to_y[i] = turned_y;
  }
}

/// Shorten lengths so that they end between two lines across an axis.
MRPBENCH_WIDE void clip_axis(std::size_t count, const double* along, double from, double low, double high,
                             double* lengths) {
  for (std::size_t i = 0; i < count; ++i) {
    const double limit = ((along[i] > 0 ? high : low) - from) / along[i];
    lengths[i] = ((along[i] != 0) & (limit < lengths[i])) ? limit : lengths[i];
  }
}

MRPBENCH_WIDE void find_cells(std::size_t count, const double* x, const double* y, Point origin, Frame frame,
                              const double* lengths, Cell* cells) {
  frame.cells(
      count, [&](std::size_t i) { return origin + Point{x[i], y[i]} * lengths[i]; },
      [&](std::size_t i, Cell c) { cells[i] = c; });
}

}  // namespace

void Beams::aim(std::size_t count, Point origin, double yaw) {
  origin_ = origin;
  yaw_ = std::remainder(yaw, kTurn);
  if (size() != count) {
    for (auto* it : {&ahead_x_, &ahead_y_, &along_x_, &along_y_}) it->resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = static_cast<double>(i) * 2 * std::numbers::pi / static_cast<double>(count);
      ahead_x_[i] = std::cos(angle);
      ahead_y_[i] = std::sin(angle);
    }
  }
  turn(count, ahead_x_.data(), ahead_y_.data(), {std::cos(yaw), std::sin(yaw)}, along_x_.data(), along_y_.data());
}

std::pair<std::size_t, std::size_t> Beams::around(Point p, double off) const {
  const Point away = p - origin_;
  const double distance = sim::length(away);
  if (distance <= off) return {0, size()};
  // No less than the arc sine, which is x at 0 and pi / 2 at 1, and grows more slowly than this in between.
  const double sine = off / distance, half = sine + (std::numbers::pi / 2 - 1) * sine * sine * sine + sim::kRoughAngle;
  const double bearing = sim::rough_angle(away) - yaw_, per_radian = static_cast<double>(size()) / kTurn;
  const int count = static_cast<int>(size());
  const int first = whole_below((bearing - half) * per_radian), last = whole_below((bearing + half) * per_radian) + 1;
  const int rest = first % count;
  return {static_cast<std::size_t>(rest < 0 ? rest + count : rest),
          static_cast<std::size_t>(std::min(count, last - first + 1))};
}

void Beams::clip(const Frame& frame, std::span<double> lengths) const {
  const double left = frame.origin.x * frame.resolution, bottom = frame.origin.y * frame.resolution;
  const double right = left + frame.width * frame.resolution, top = bottom + frame.height * frame.resolution;
  clip_axis(size(), along_x_.data(), origin_.x, left, right, lengths.data());
  clip_axis(size(), along_y_.data(), origin_.y, bottom, top, lengths.data());
}

void Beams::end_cells(const Frame& frame, std::span<const double> lengths, std::span<Cell> cells) const {
  find_cells(size(), along_x_.data(), along_y_.data(), origin_, frame, lengths.data(), cells.data());
}

}  // namespace mrpbench::local
