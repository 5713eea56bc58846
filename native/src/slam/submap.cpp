#include "mrpbench_slam/submap.hpp"

namespace mrpbench::slam {

namespace {

/// Twentieths of the logarithms of odds: a return is right with probability 0.7, a beam that passes with 0.6.
constexpr int kHit = 17, kMiss = -8;
/// A cell that was seen often changes after a few scans.
constexpr int kMost = 51, kLeast = -40;

}  // namespace

void Submap::change(Cell it, int by) {
  Odds& cell = cells_.at(it);
  if (cell.scan == static_cast<std::uint8_t>(scans_)) return;
  cell.scan = static_cast<std::uint8_t>(scans_);
  const bool before = cell.odds > 0;
  cell.odds = static_cast<std::int8_t>(std::clamp(cell.odds + by, kLeast, kMost));
  if (cell.odds > 0 && !before) field_.raise(it);
  if (cell.odds <= 0 && before) field_.lower(it, [this](Cell near) { return occupied(near); });
}

void Submap::insert(const Scan& scan, Pose pose) {
  ++scans_;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw), per_metre = 1 / field_.resolution();
  const auto in_cells = [&](Point point) { return placed(pose, c, s, point) * per_metre; };
  const Point from = in_cells(scan.origin);
  Cell low{floor_index(from.x), floor_index(from.y)}, high = low;
  for (const auto* ends : {&scan.hits, &scan.misses}) {
    for (const Point& end : *ends) {
      const Point to = in_cells(end);
      low = {std::min(low.column, floor_index(to.x)), std::min(low.row, floor_index(to.y))};
      high = {std::max(high.column, floor_index(to.x)), std::max(high.row, floor_index(to.y))};
    }
  }
  cells_.cover({low, {high.column + 1, high.row + 1}});
  for (const Point& end : scan.hits) {
    const Point to = in_cells(end);
    change({floor_index(to.x), floor_index(to.y)}, kHit);
  }
  for (const auto* ends : {&scan.hits, &scan.misses}) {
    for (const Point& end : *ends) {
      const Point to = in_cells(end);
      traverse(from.x, from.y, to.x, to.y, [this](Cell it) { change(it, kMiss); });
    }
  }
}

double Submap::overlap(const Scan& scan, Pose pose) const {
  constexpr int kNear = 3;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw), per_metre = 1 / field_.resolution();
  const auto seen = [this](int column, int row) { return cells_.value({column, row}).scan != 0; };
  std::size_t count = 0;
  for (const Return& it : scan.returns) {
    const Point at = placed(pose, c, s, it.point) * per_metre;
    const int x = floor_index(at.x), y = floor_index(at.y);
    count += seen(x, y) || seen(x - kNear, y) || seen(x + kNear, y) || seen(x, y - kNear) || seen(x, y + kNear);
  }
  return scan.returns.empty() ? 0 : static_cast<double>(count) / static_cast<double>(scan.returns.size());
}

Field Submap::field_of(double deviation) const {
  Field field(field_.resolution(), deviation);
  const Box& box = cells_.box();
  for (int y = box.low.row; y < box.high.row; ++y) {
    for (int x = box.low.column; x < box.high.column; ++x) {
      if (occupied({x, y})) field.raise({x, y});
    }
  }
  return field;
}

}  // namespace mrpbench::slam
