#include "mrpbench_local/path_grid.hpp"

#include <algorithm>

namespace mrpbench::local {

void PathGrid::take(const Frame& frame, Point robot, Point first, std::span<const Point> rest, const Pruning& pruning) {
  cells_.clear();
  beyond_.clear();
  points_.clear();
  last_ = first;
  const double extent = std::max(frame.width, frame.height) * frame.resolution / 2;
  const double limit = pruning.shorten ? std::min(extent, pruning.prune_distance) : extent;
  // Poses as dense as cells, from the first one near enough.
  const auto add = [&](Point p) {
    if (sim::length(p - robot) > limit) return cells_.empty();
    const Cell c = frame.cell(p);
    if (!frame.holds(c)) return cells_.empty();
    if (cells_.empty() || !(cells_.back() == c)) {
      cells_.push_back(c);
      points_.push_back(p);
    }
    last_ = points_.back() = p;
    return true;
  };
  if (!add(first)) return;
  Point from = first;
  for (const Point& to : rest) {
    const Point along = to - from;
    const int count = std::max(1, static_cast<int>(std::ceil(sim::length(along) / frame.resolution)));
    for (int i = 1; i <= count; ++i) {
      if (!add(i == count ? to : from + along * (static_cast<double>(i) / count))) return;
    }
    if (&to == &rest.back() && sim::length(along) > 0) {
      const Point ahead = along * (1 / sim::length(along));
      for (double far = frame.resolution; far <= pruning.beyond_end; far += frame.resolution) {
        const Cell c = frame.cell(to + ahead * far);
        if (frame.holds(c)) beyond_.push_back(c);
      }
    }
    from = to;
  }
}

void PathGrid::spread(const Frame& frame) {
  const auto width = static_cast<std::size_t>(frame.width), height = static_cast<std::size_t>(frame.height);
  const auto far = static_cast<std::uint16_t>(std::min<std::size_t>(frame.size() + 1, 60000));
  distance_.assign(frame.size(), far);
  for (const Cell& c : cells_) distance_[frame.index(c)] = 0;
  for (const Cell& c : beyond_) distance_[frame.index(c)] = 0;
  const auto nearer = [](std::uint16_t mine, std::uint16_t next) {
    return std::min<std::uint16_t>(mine, static_cast<std::uint16_t>(next + 1));
  };
  for (std::size_t y = 1; y < height; ++y) {
    std::uint16_t* const row = &distance_[y * width];
    const std::uint16_t* const below = row - width;
    for (std::size_t x = 0; x < width; ++x) row[x] = nearer(row[x], below[x]);
  }
  for (std::size_t y = height - 1; y-- > 0;) {
    std::uint16_t* const row = &distance_[y * width];
    const std::uint16_t* const above = row + width;
    for (std::size_t x = 0; x < width; ++x) row[x] = nearer(row[x], above[x]);
  }
  for (std::size_t y = 0; y < height; ++y) {
    std::uint16_t* const row = &distance_[y * width];
    for (std::size_t x = 1; x < width; ++x) row[x] = nearer(row[x], row[x - 1]);
    for (std::size_t x = width - 1; x-- > 0;) row[x] = nearer(row[x], row[x + 1]);
  }
}

}  // namespace mrpbench::local
