#include "mrpbench_local/path/reroute.hpp"

#include <algorithm>
#include <limits>

#include "local/path/ways.hpp"

namespace mrpbench::local {

namespace {

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
  const auto is_near = [&](Cell c) { return path.distance(frame, c) <= farthest / frame.resolution; };
  const Ways ways(ground, start, is_near);
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
  const auto is_near = [&](Cell c) { return path.distance(frame, c) <= farthest / frame.resolution; };
  const Ways ways(ground, start, is_near);
  if (std::isfinite(ways.cost(goal))) return std::nullopt;
  const std::optional<Cell> found = nearest_place(ground, ways, end, tolerance);
  if (!found) return std::nullopt;
  std::vector<Point> points = points_to(ground, ways, *found);
  if (points.empty()) points.push_back(frame.centre(*found));  // the robot is there already
  return points;
}

std::optional<std::vector<Point>> plan(const Costmap& costmap, Point robot, Point goal, double tolerance) {
  const Frame& frame = costmap.frame();
  const Cell start = frame.cell(robot), end = frame.cell(goal);
  if (!costmap.knows() || !frame.holds(start) || !frame.holds(end)) return std::nullopt;
  const Ground ground(costmap);
  const Ways ways(ground, start, [](Cell) { return true; }, end);
  std::vector<Point> points{robot};
  const auto extend = [&](Cell c) {
    const std::vector<Point> way = points_to(ground, ways, c);
    points.insert(points.end(), way.begin(), way.end());
  };
  if (std::isfinite(ways.cost(end))) {
    extend(end);
    if (points.size() > 1) points.pop_back();
    points.push_back(goal);
    return points;
  }
  const std::optional<Cell> beside = nearest_place(ground, ways, goal, tolerance);
  if (!beside) return std::nullopt;
  extend(*beside);
  return points;
}

}  // namespace mrpbench::local
