#include "mrpbench_slam/scan.hpp"

#include <algorithm>

namespace mrpbench::slam {

namespace {

/// Metres between the neighbours of a return on one surface, at most, as a share of its range and at least.
constexpr double kGapShare = 0.15, kGap = 0.1;

Point unit_normal(Point before, Point after, double most) {
  const Point along = after - before;
  const double size = sim::length(along);
  if (!(size > 1e-6 && size < most)) return {};
  return Point{-along.y, along.x} * (1 / size);
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
  std::vector<std::size_t> returned;
  returned.reserve(beams);
  scan.hits.reserve(beams);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const double distance = ranges[beam], angle = static_cast<double>(beam) * (2 * std::numbers::pi / static_cast<double>(beams));
    if (!(distance >= lidar.min_range)) continue;
    const bool hit = distance < lidar.range;
    const Point end = lidar.mount + Point{std::cos(angle), std::sin(angle)} * (hit ? distance : lidar.range);
    (hit ? scan.hits : scan.misses).push_back(end);
    if (hit) returned.push_back(beam);
  }
  const std::size_t count = scan.hits.size(), used = std::min(count, static_cast<std::size_t>(max_beams));
  scan.returns.reserve(used);
  // Neighbours some beams away, because the noise of the nearest ones would turn the normal.
  const std::size_t apart = std::max<std::size_t>(1, beams / 120);
  for (std::size_t i = 0; i < used; ++i) {
    const std::size_t index = i * count / used;
    const std::size_t before = (index + count - apart) % count, after = (index + apart) % count;
    const double most = std::max(kGap, kGapShare * ranges[returned[index]]) * 2;
    scan.returns.push_back({scan.hits[index], unit_normal(scan.hits[before], scan.hits[after], most)});
  }
  return scan;
}

}  // namespace mrpbench::slam
