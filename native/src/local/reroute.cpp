#include "mrpbench_local/reroute.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include "mrpbench_local/footprint.hpp"

namespace mrpbench::local {

namespace {

/// Cost of a step of one cell: through higher cost is like going farther, as in Nav2's global planner.
double step_cost(std::uint8_t cost) {
  return 1 + cost / 64.0;
}

bool passable(const Costmap& costmap, Cell c) {
  return costmap.frame().holds(c) && costmap.at(c) < kInscribed;
}

/// Cheapest ways from one cell (E. W. Dijkstra, Numerische Mathematik 1, 1959), not farther from the path than allowed.
class Ways {
 public:
  Ways(const Costmap& costmap, const PathGrid& path, Cell start, double farthest_cells)
      : frame_(costmap.frame()), cost_(frame_.size(), std::numeric_limits<double>::infinity()), from_(frame_.size()) {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    cost_[frame_.index(start)] = 0;
    from_[frame_.index(start)] = start;
    open.push({0, frame_.index(start)});
    while (!open.empty()) {
      const auto [cost, index] = open.top();
      open.pop();
      if (cost > cost_[index]) continue;
      const Cell here{static_cast<int>(index) % frame_.width, static_cast<int>(index) / frame_.width};
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Cell next{here.x + dx, here.y + dy};
          if (next == here || !passable(costmap, next)) continue;
          if (path.distance(frame_, next) > farthest_cells) continue;
          const double length = dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0;
          const double total = cost + length * step_cost(costmap.at(next));
          const std::size_t at = frame_.index(next);
          if (total >= cost_[at]) continue;
          cost_[at] = total;
          from_[at] = here;
          open.push({total, at});
        }
      }
    }
  }

  double cost(Cell c) const { return cost_[frame_.index(c)]; }

  std::vector<Cell> to(Cell c) const {
    std::vector<Cell> way{c};
    while (!(from_[frame_.index(c)] == c)) way.push_back(c = from_[frame_.index(c)]);
    std::reverse(way.begin(), way.end());
    return way;
  }

 private:
  Frame frame_;
  std::vector<double> cost_;
  std::vector<Cell> from_;
};

/// Corners of a way between which there is a free line that costs no more than the way's dearest cell.
std::vector<Cell> straightened(const Costmap& costmap, const std::vector<Cell>& way) {
  std::vector<Cell> result;
  for (std::size_t at = 0; at + 1 < way.size();) {
    std::size_t next = at + 1;
    std::uint8_t dearest = costmap.at(way[next]);
    for (std::size_t k = at + 2; k < way.size(); ++k) {
      dearest = std::max(dearest, costmap.at(way[k]));
      if (line(way[at], way[k], [&](Cell c) { return c == way[at] || costmap.at(c) <= dearest; })) next = k;
    }
    result.push_back(way[next]);
    at = next;
  }
  return result;
}

}  // namespace

bool is_free(const Costmap& costmap, Pose pose, bool by_radius) {
  const Frame& frame = costmap.frame();
  const Cell centre = frame.cell({pose.x, pose.y});
  if (!costmap.knows() || !frame.holds(centre)) return true;
  if (by_radius) return costmap.at(centre) < kInscribed;
  std::vector<Point> corners;
  place(costmap.options().footprint, pose, corners);
  bool free = costmap.at(centre) < kLethal;
  for (std::size_t i = 0; free && i < corners.size(); ++i) {
    free = line(frame.cell(corners[i]), frame.cell(corners[(i + 1) % corners.size()]),
                [&](Cell c) { return !frame.holds(c) || costmap.at(c) < kLethal; });
  }
  return free;
}

std::optional<std::vector<Point>> reroute(const Costmap& costmap, Point robot, Point first, std::span<const Point> rest,
                                          double farthest) {
  const Frame& frame = costmap.frame();
  const Cell start = frame.cell(robot);
  if (!costmap.knows() || !frame.holds(start)) return std::nullopt;
  PathGrid path;
  path.take(frame, robot, first, rest, {.prune_distance = 0, .shorten = false});
  const std::vector<Cell>& cells = path.cells();
  const auto blocked = std::find_if(cells.begin(), cells.end(), [&](Cell c) { return !passable(costmap, c); });
  if (blocked == cells.end()) return std::nullopt;
  path.spread(frame);
  const Ways ways(costmap, path, start, farthest / frame.resolution);
  double least = std::numeric_limits<double>::infinity();
  std::size_t rejoin = cells.size();
  for (auto k = static_cast<std::size_t>(blocked - cells.begin()) + 1; k < cells.size(); ++k) {
    if (!passable(costmap, cells[k])) continue;
    const double total = ways.cost(cells[k]) + static_cast<double>(cells.size() - k);
    if (total < least) {
      least = total;
      rejoin = k;
    }
  }
  if (rejoin == cells.size()) return std::nullopt;
  std::vector<Point> points;
  for (const Cell& c : straightened(costmap, ways.to(cells[rejoin]))) points.push_back(frame.centre(c));
  if (points.empty()) return std::nullopt;
  points.back() = path.points()[rejoin];
  return points;
}

}  // namespace mrpbench::local
