#include "mrpbench_local/costmap/collision.hpp"

#include <algorithm>

#include "mrpbench_local/costmap/footprint.hpp"

namespace mrpbench::local {

bool is_free(const Costmap& costmap, Pose pose, bool by_radius) {
  const Frame& frame = costmap.frame();
  const Cell centre = frame.cell({pose.x, pose.y});
  if (!costmap.knows() || !frame.holds(centre)) return true;
  if (by_radius) return costmap.is_free(centre, {pose.x, pose.y});
  std::vector<Point> corners;
  place(costmap.options().footprint, pose, corners);
  bool free = costmap.at(centre) < kLethal;
  for (std::size_t i = 0; free && i < corners.size(); ++i) {
    free = line(frame.cell(corners[i]), frame.cell(corners[(i + 1) % corners.size()]),
                [&](Cell c) { return !frame.holds(c) || costmap.at(c) < kLethal; });
  }
  return free;
}

std::optional<std::uint8_t> outline_cost(const Costmap& costmap, std::span<const Point> corners) {
  const Frame& frame = costmap.frame();
  for (const Point& p : corners) {
    if (!frame.holds(frame.cell(p))) return std::nullopt;
  }
  std::uint8_t worst = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    line(frame.cell(corners[i]), frame.cell(corners[(i + 1) % corners.size()]), [&](Cell c) {
      worst = std::max(worst, costmap.at(c));
      return true;
    });
  }
  return worst;
}

}  // namespace mrpbench::local
