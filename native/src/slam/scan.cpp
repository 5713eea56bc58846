#include "mrpbench_slam/scan.hpp"

#include <algorithm>

namespace mrpbench::slam {

namespace {

/// Metres from a return to the neighbours that give its normal, at least, so that the noise of ranges turns it little.
constexpr double kBaseline = 0.15;
/// Beams to either side within which these are looked for.
constexpr std::size_t kFarthest = 15;
/// A neighbour farther away than this many times the baseline is on another surface.
constexpr double kGap = 2.5;
/// Cosine of the turn between both sides up to which a surface is straight.
constexpr double kStraight = 0.8;

/// The neighbour of a hit towards one side, the number of hits itself if there is none.
std::size_t neighbour(const std::vector<Point>& hits, std::size_t index, std::size_t step) {
  const std::size_t count = hits.size();
  for (std::size_t k = 1, at = index; k <= kFarthest && k < count; ++k) {
    at = (at + step) % count;
    const double distance = sim::length(hits[at] - hits[index]);
    if (distance >= kGap * kBaseline) return count;
    if (distance >= kBaseline) return at;
  }
  return count;
}

/// The unit vector across a surface at a hit; zero where its neighbours are on no straight one.
Point normal_at(const std::vector<Point>& hits, std::size_t index) {
  const std::size_t count = hits.size(), before = neighbour(hits, index, count - 1), after = neighbour(hits, index, 1);
  if (before == count || after == count) return {};
  const Point one = hits[index] - hits[before], other = hits[after] - hits[index], along = one + other;
  if (dot(one, other) < kStraight * sim::length(one) * sim::length(other)) return {};
  return Point{-along.y, along.x} * (1 / sim::length(along));
}

}  // namespace

double Scan::reach() const {
  double most = 0;
  for (const Return& it : returns) most = std::max(most, sim::length(it.point));
  return most;
}

Scan scan_of(std::span<const double> ranges, const Lidar& lidar, int max_beams) {
  Scan scan;
  scan.origin = lidar.mount;
  const std::size_t beams = ranges.size();
  scan.hits.reserve(beams);
  const auto missed = [&](std::size_t beam) { return ranges[beam % beams] >= lidar.range; };
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const double distance = ranges[beam],
                 angle = static_cast<double>(beam) * (2 * std::numbers::pi / static_cast<double>(beams));
    if (!(distance >= lidar.min_range)) continue;
    const Point along{std::cos(angle), std::sin(angle)};
    if (!missed(beam)) {
      scan.hits.push_back(lidar.mount + along * distance);
    } else if (missed(beam + 1) && missed(beam + beams - 1)) {
      scan.misses.push_back(lidar.mount + along * lidar.range);
    }
  }
  const std::size_t count = scan.hits.size(), used = std::min(count, static_cast<std::size_t>(max_beams));
  scan.returns.reserve(used);
  for (std::size_t i = 0; i < used; ++i) {
    const std::size_t index = i * count / used;
    scan.returns.push_back({scan.hits[index], normal_at(scan.hits, index)});
  }
  return scan;
}

}  // namespace mrpbench::slam
