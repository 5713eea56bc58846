#include "mrpbench_local/path/reroute.hpp"

#include <algorithm>
#include <limits>
#include <queue>

namespace mrpbench::local {

namespace {

/// Cost of a step of one cell: a cell of higher cost counts as a longer way, as in Nav2's global planner.
double step_cost(std::uint8_t cost) {
  return 1 + cost / 64.0;
}

/// Where a robot can be: cells that are free in its costmap and not on the outlines of the static map, seen or not.
class Ground {
 public:
  explicit Ground(const Costmap& costmap) : costmap_(costmap), walls_(costmap.frame().size(), kFree) {
    costmap.draw_walls(walls_);
  }
  const Frame& frame() const { return costmap_.frame(); }
  std::uint8_t at(Cell c) const { return std::max(costmap_.at(c), walls_[frame().index(c)]); }
  bool is_passable(Cell c) const { return frame().holds(c) && at(c) < kInscribed; }
  /// Tell whether a robot may go from one cell to the next; a robot that is too near to an obstacle may leave it.
  bool is_open(Cell here, Cell next) const {
    return is_passable(next) || (frame().holds(next) && at(next) < kLethal && !is_passable(here));
  }
  /// Tell whether nothing solid is between two cells.
  bool sees(Cell a, Cell b) const {
    return line(a, b, [&](Cell c) { return frame().holds(c) && at(c) < kLethal; });
  }
  /// Tell whether there is room for a robot that stops in a neighbouring cell of `c`.
  bool is_roomy(Cell c) const {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!is_passable({c.x + dx, c.y + dy})) return false;
      }
    }
    return true;
  }

 private:
  const Costmap& costmap_;
  std::vector<std::uint8_t> walls_;
};

/// Cheapest ways from one cell (E. W. Dijkstra, Numerische Mathematik 1, 1959), not farther from the path than allowed.
class Ways {
 public:
  Ways(const Ground& ground, const PathGrid& path, Cell start, double farthest_cells)
      : frame_(ground.frame()), cost_(frame_.size(), std::numeric_limits<double>::infinity()), from_(frame_.size()) {
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
          if (next == here || !ground.is_open(here, next)) continue;
          if (path.distance(frame_, next) > farthest_cells) continue;
          const double length = dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0;
          const double total = cost + length * step_cost(ground.at(next));
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

/// Corners of a way between which there is a free line that costs no more than the most expensive cell of the way.
std::vector<Cell> straightened(const Ground& ground, const std::vector<Cell>& way) {
  std::vector<Cell> result;
  for (std::size_t at = 0; at + 1 < way.size();) {
    std::size_t next = at + 1;
    std::uint8_t dearest = ground.at(way[next]);
    for (std::size_t k = at + 2; k < way.size(); ++k) {
      dearest = std::max(dearest, ground.at(way[k]));
      if (line(way[at], way[k], [&](Cell c) { return c == way[at] || ground.at(c) <= dearest; })) next = k;
    }
    result.push_back(way[next]);
    at = next;
  }
  return result;
}

/// Corners of the cheapest way to a cell, as points.
std::vector<Point> points_to(const Ground& ground, const Ways& ways, Cell c) {
  std::vector<Point> points;
  for (const Cell& corner : straightened(ground, ways.to(c))) points.push_back(ground.frame().centre(corner));
  return points;
}

/// The rest of a path on the map, beyond the part that the controller uses too.
PathGrid whole_path(const Frame& frame, Point robot, Point first, std::span<const Point> rest) {
  PathGrid path;
  path.take(frame, robot, first, rest, {.prune_distance = 0, .shorten = false});
  return path;
}

}  // namespace

std::optional<std::vector<Point>> reroute(const Costmap& costmap, Point robot, Point first, std::span<const Point> rest,
                                          double farthest) {
  const Frame& frame = costmap.frame();
  const Cell start = frame.cell(robot);
  if (!costmap.knows() || !frame.holds(start)) return std::nullopt;
  const Ground ground(costmap);
  PathGrid path = whole_path(frame, robot, first, rest);
  const std::vector<Cell>& cells = path.cells();
  if (cells.empty()) return std::nullopt;
  auto from = cells.begin();  // of where the path may be joined
  if (ground.sees(start, cells.front())) {
    from = std::find_if(cells.begin(), cells.end(), [&](Cell c) { return !ground.is_passable(c); });
    if (from == cells.end()) return std::nullopt;
    ++from;
  }
  path.spread(frame);
  const Ways ways(ground, path, start, farthest / frame.resolution);
  double least = std::numeric_limits<double>::infinity();
  std::size_t rejoin = cells.size();
  for (auto k = static_cast<std::size_t>(from - cells.begin()); k < cells.size(); ++k) {
    if (!ground.is_passable(cells[k])) continue;
    const double total = ways.cost(cells[k]) + static_cast<double>(cells.size() - k);
    if (total < least) {
      least = total;
      rejoin = k;
    }
  }
  if (rejoin == cells.size()) return std::nullopt;
  std::vector<Point> points = points_to(ground, ways, cells[rejoin]);
  if (points.empty()) return std::nullopt;
  points.back() = path.points()[rejoin];
  return points;
}

std::optional<std::vector<Point>> approach(const Costmap& costmap, Point robot, Point first,
                                           std::span<const Point> rest, double farthest, double tolerance) {
  const Frame& frame = costmap.frame();
  const Point end = rest.empty() ? first : rest.back();
  const Cell start = frame.cell(robot), goal = frame.cell(end);
  if (!costmap.knows() || !frame.holds(start) || !frame.holds(goal)) return std::nullopt;
  const Ground ground(costmap);
  PathGrid path = whole_path(frame, robot, first, rest);
  const auto is_free = [&](Cell c) { return ground.is_passable(c); };
  if (path.empty()) return std::nullopt;
  if (ground.sees(start, path.cells().front()) && std::ranges::all_of(path.cells(), is_free)) return std::nullopt;
  path.spread(frame);
  const Ways ways(ground, path, start, farthest / frame.resolution);
  if (std::isfinite(ways.cost(goal))) return std::nullopt;
  const int around = static_cast<int>(tolerance / frame.resolution);
  double nearest = tolerance, least = std::numeric_limits<double>::infinity();
  Cell found = goal;
  for (int dy = -around; dy <= around; ++dy) {
    for (int dx = -around; dx <= around; ++dx) {
      const Cell c{goal.x + dx, goal.y + dy};
      if (!ground.is_roomy(c) || !std::isfinite(ways.cost(c))) continue;
      const double away = sim::length(frame.centre(c) - end);
      if (away > nearest || (away == nearest && ways.cost(c) >= least)) continue;
      nearest = away;
      least = ways.cost(c);
      found = c;
    }
  }
  if (!std::isfinite(least)) return std::nullopt;
  std::vector<Point> points = points_to(ground, ways, found);
  if (points.empty()) points.push_back(frame.centre(found));  // the robot is there already
  return points;
}

}  // namespace mrpbench::local
