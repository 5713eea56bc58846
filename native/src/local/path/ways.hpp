// Ways of a robot over the cells of its costmap.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <vector>

#include "mrpbench_local/costmap/costmap.hpp"

namespace mrpbench::local {

/// Cost of a step of one cell: a cell of higher cost counts as a longer way, as in Nav2's global planner.
inline double step_cost(std::uint8_t cost) {
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

/// Cheapest ways from one cell over the cells that `may_use` allows: to all of them (E. W. Dijkstra, Numerische
/// Mathematik 1, 1959), or, with a goal, until the way to it is found (P. E. Hart, N. J. Nilsson and B. Raphael, IEEE
/// Transactions on Systems Science and Cybernetics 4, 1968).
class Ways {
 public:
  template <class MayUse>
  Ways(const Ground& ground, Cell start, MayUse&& may_use, std::optional<Cell> goal = std::nullopt)
      : frame_(ground.frame()), cost_(frame_.size(), std::numeric_limits<double>::infinity()), from_(frame_.size()) {
    struct Entry {
      double bound, cost;
      std::size_t at;
      bool operator>(const Entry& it) const {
        return bound != it.bound ? bound > it.bound : cost != it.cost ? cost > it.cost : at > it.at;
      }
    };
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    cost_[frame_.index(start)] = 0;
    from_[frame_.index(start)] = start;
    open.push({left(start, goal), 0, frame_.index(start)});
    while (!open.empty()) {
      const auto [bound, cost, index] = open.top();
      open.pop();
      if (cost > cost_[index]) continue;
      const Cell here{static_cast<int>(index) % frame_.width, static_cast<int>(index) / frame_.width};
      if (goal == here) return;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Cell next{here.x + dx, here.y + dy};
          if (next == here || !ground.is_open(here, next) || !may_use(next)) continue;
          const double length = dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0;
          const double total = cost + length * step_cost(ground.at(next));
          const std::size_t at = frame_.index(next);
          if (total >= cost_[at]) continue;
          cost_[at] = total;
          from_[at] = here;
          open.push({total + left(next, goal), total, at});
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
  /// No way to the goal costs less: steps along rows, columns and diagonals over cells that cost nothing.
  static double left(Cell c, const std::optional<Cell>& goal) {
    if (!goal) return 0;
    const int dx = std::abs(goal->x - c.x), dy = std::abs(goal->y - c.y);
    return std::max(dx, dy) + (std::numbers::sqrt2 - 1) * std::min(dx, dy);
  }

  Frame frame_;
  std::vector<double> cost_;
  std::vector<Cell> from_;
};

/// Corners of a way between which there is a free line that costs no more than the most expensive cell of the way.
inline std::vector<Cell> straightened(const Ground& ground, const std::vector<Cell>& way) {
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
inline std::vector<Point> points_to(const Ground& ground, const Ways& ways, Cell c) {
  std::vector<Point> points;
  for (const Cell& corner : straightened(ground, ways.to(c))) points.push_back(ground.frame().centre(corner));
  return points;
}

/// The reached cell with room around it that is nearest to a point, at most `tolerance` metres from it, and of those at
/// the same distance the one with the cheapest way.
inline std::optional<Cell> nearest_place(const Ground& ground, const Ways& ways, Point wanted, double tolerance) {
  const Frame& frame = ground.frame();
  const Cell goal = frame.cell(wanted);
  const int around = static_cast<int>(tolerance / frame.resolution);
  double nearest = tolerance, least = std::numeric_limits<double>::infinity();
  std::optional<Cell> found;
  for (int dy = -around; dy <= around; ++dy) {
    for (int dx = -around; dx <= around; ++dx) {
      const Cell c{goal.x + dx, goal.y + dy};
      if (!ground.is_roomy(c) || !std::isfinite(ways.cost(c))) continue;
      const double away = sim::length(frame.centre(c) - wanted);
      if (away > nearest || (away == nearest && ways.cost(c) >= least)) continue;
      nearest = away;
      least = ways.cost(c);
      found = c;
    }
  }
  return found;
}

}  // namespace mrpbench::local
