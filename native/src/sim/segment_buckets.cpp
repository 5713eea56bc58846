#include "mrpbench_sim/segment_buckets.hpp"

namespace mrpbench::sim {

namespace {

constexpr double kMostCells = 1 << 20;

}  // namespace

SegmentBuckets::SegmentBuckets(std::span<const Segment> segments, double reach, double cell) : cell_(cell) {
  if (segments.empty()) return;
  Point low = segments[0].start, high = low;
  for (const Segment& it : segments) {
    low = {std::min({low.x, it.start.x, it.end.x}), std::min({low.y, it.start.y, it.end.y})};
    high = {std::max({high.x, it.start.x, it.end.x}), std::max({high.y, it.start.y, it.end.y})};
  }
  origin_ = low - Point{reach, reach};
  const Point size = high - low + Point{2 * reach, 2 * reach};
  while ((size.x / cell_ + 1) * (size.y / cell_ + 1) > kMostCells) cell_ *= 1.5;
  columns_ = static_cast<std::int64_t>(size.x / cell_) + 1;
  rows_ = static_cast<std::int64_t>(size.y / cell_) + 1;

  const double within = reach + cell_ * 0.70711;  // of the middle of a square
  const auto each = [&](auto&& visit) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const auto [a, b] = segments[i];
      const auto column = [&](double x) { return static_cast<std::int64_t>(std::floor((x - origin_.x) / cell_)); };
      const auto row = [&](double y) { return static_cast<std::int64_t>(std::floor((y - origin_.y) / cell_)); };
      const std::int64_t left = std::max<std::int64_t>(column(std::min(a.x, b.x) - within), 0);
      const std::int64_t right = std::min(column(std::max(a.x, b.x) + within), columns_ - 1);
      const std::int64_t bottom = std::max<std::int64_t>(row(std::min(a.y, b.y) - within), 0);
      const std::int64_t top = std::min(row(std::max(a.y, b.y) + within), rows_ - 1);
      for (std::int64_t y = bottom; y <= top; ++y) {
        for (std::int64_t x = left; x <= right; ++x) {
          const Point middle = origin_ + Point{(static_cast<double>(x) + 0.5), (static_cast<double>(y) + 0.5)} * cell_;
          if (length(gap(segments[i], middle)) <= within) visit(static_cast<std::size_t>(y * columns_ + x), i);
        }
      }
    }
  };
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  each([&](std::size_t square, std::size_t) { ++first_[square + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  segments_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<std::int64_t> next(first_.begin(), first_.end() - 1);
  each([&](std::size_t square, std::size_t i) {
    segments_[static_cast<std::size_t>(next[square]++)] = static_cast<std::int32_t>(i);
  });
}

std::span<const std::int32_t> SegmentBuckets::near(Point point) const {
  const Point place = (point - origin_) * (1 / cell_);
  if (!(place.x >= 0 && place.y >= 0 && place.x < static_cast<double>(columns_) &&
        place.y < static_cast<double>(rows_))) {
    return {};
  }
  const auto square =
      static_cast<std::size_t>(static_cast<std::int64_t>(place.y) * columns_ + static_cast<std::int64_t>(place.x));
  return {segments_.data() + first_[square], static_cast<std::size_t>(first_[square + 1] - first_[square])};
}

}  // namespace mrpbench::sim
