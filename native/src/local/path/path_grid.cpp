#include "mrpbench_local/path/path_grid.hpp"

#include <algorithm>
#include <limits>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local {

namespace {

/// Greater than any distance within the largest frame, and small enough that additions do not overflow.
constexpr std::int16_t kFar = 20000;

}  // namespace

std::size_t PathGrid::take(const Frame& frame, Point robot, Point first, std::span<const Point> rest,
                           const Pruning& pruning) {
  cells_.clear();
  beyond_.clear();
  points_.clear();
  goal_ = first;
  left_ = std::numeric_limits<double>::infinity();
  const double extent = std::max(frame.width, frame.height) * frame.resolution / 2;
  const double limit = pruning.shorten ? std::min(extent, pruning.prune_distance) : extent;
  // Poses one cell apart, from the first one that is near enough.
  const auto add = [&](Point p) {
    if (sim::length(p - robot) > limit) return cells_.empty();
    const Cell c = frame.cell(p);
    if (!frame.holds(c)) return cells_.empty();
    if (cells_.empty() || !(cells_.back() == c)) {
      cells_.push_back(c);
      points_.push_back(p);
    }
    goal_ = points_.back() = p;
    return true;
  };
  if (!add(first)) return 0;
  Point from = first;
  double way = 0;
  for (const Point& to : rest) {
    const Point along = to - from;
    const double length = sim::length(along);
    const int count = std::max(1, static_cast<int>(std::ceil(length / frame.resolution)));
    way += length;
    for (int i = 1; i <= count; ++i) {
      if (!add(i == count ? to : from + along * (static_cast<double>(i) / count))) {
        return static_cast<std::size_t>(&to - rest.data()) + 1;
      }
    }
    if (&to == &rest.back() && length > 0) {
      const Point ahead = along * (1 / length);
      for (double far = frame.resolution; far <= pruning.beyond_end; far += frame.resolution) {
        const Point p = to + ahead * far;
        if (!frame.holds(frame.cell(p))) break;
        beyond_.push_back(frame.cell(p));
        if (way > frame.resolution) goal_ = p;
      }
    }
    from = to;
  }
  left_ = way;
  return rest.size();
}

/// Along rows first, for each of the few cells of the path, then along columns. To the window a cell above or below it
/// is one of its first or last row, so many steps farther away.
MRPBENCH_WIDE void PathGrid::spread(const Frame& frame, Cell low, Cell high) {
  low_ = low = {std::max(low.x, 0), std::max(low.y, 0)};
  high_ = high = {std::min(high.x, frame.width - 1), std::min(high.y, frame.height - 1)};
  if (low.x > high.x || low.y > high.y) return;
  const auto count = static_cast<std::size_t>(high.x - low.x + 1);
  distance_.resize(frame.size());
  const auto row_of = [&](int y) { return &distance_[frame.index({low.x, y})]; };
  for (int y = low.y; y <= high.y; ++y) std::fill_n(row_of(y), count, kFar);
  if (const auto width = static_cast<std::size_t>(frame.width); away_.size() != 2 * width) {
    away_.resize(2 * width);
    for (std::size_t i = 0; i < away_.size(); ++i) {
      away_[i] = static_cast<std::int16_t>(std::abs(static_cast<int>(i) - frame.width));
    }
  }
  for (const auto* cells : {&cells_, &beyond_}) {
    for (const Cell& c : *cells) {
      const int y = std::clamp(c.y, low.y, high.y);
      const auto off = static_cast<std::int16_t>(std::abs(c.y - y));
      std::int16_t* const row = row_of(y);
      const std::int16_t* const along = &away_[static_cast<std::size_t>(frame.width - c.x + low.x)];
      for (std::size_t x = 0; x < count; ++x) row[x] = std::min(row[x], static_cast<std::int16_t>(along[x] + off));
    }
  }
  const auto approach = [&](int y, int next) {
    std::int16_t* const row = row_of(y);
    const std::int16_t* const beside = row_of(next);
    for (std::size_t x = 0; x < count; ++x) row[x] = std::min(row[x], static_cast<std::int16_t>(beside[x] + 1));
  };
  for (int y = low.y + 1; y <= high.y; ++y) approach(y, y - 1);
  for (int y = high.y; y-- > low.y;) approach(y, y + 1);
}

int PathGrid::distance_from(Cell c) const {
  int least = kFar;
  for (const auto* cells : {&cells_, &beyond_}) {
    for (const Cell& it : *cells) least = std::min(least, std::abs(c.x - it.x) + std::abs(c.y - it.y));
  }
  return least;
}

}  // namespace mrpbench::local
