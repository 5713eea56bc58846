// The follower against the rules of progress, applied to all tables in every period.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "check.hpp"
#include "mrpbench_navigation/route_follower.hpp"

using namespace mrpbench::navigation;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double tolerance = 0.1, clearance = 0.7;

/// A route over a grid of metres, with waits.
struct Grid {
  std::vector<Index> first{0}, last, goal, first_corner{0}, last_corner, corner, stop, lift;
  std::vector<std::int16_t> level;
  std::vector<double> speed, yaw, distance;
  std::vector<Arrival> arrival;
  std::vector<Point> corners, step, normal;
  std::vector<double> clearances;
  std::unique_ptr<bool[]> is_wait, is_short;

  Grid(std::mt19937& random, std::size_t waypoints) : is_wait(new bool[waypoints]), is_short(new bool[waypoints]) {
    Point at;
    for (std::size_t w = 0; w < waypoints; ++w) {
      is_wait[w] = w > 0 && random() % 4 == 0;
      if (w > 0 && !is_wait[w]) (random() % 2 == 0 ? at.x : at.y) += 1;
      if (w == 0 || !is_wait[w]) corners.push_back(at);
      corner.push_back(static_cast<Index>(corners.size()) - 1);
      arrival.push_back({at.x, at.y, tolerance, nan, nan, nan});
    }
    const auto end = static_cast<Index>(corners.size()) - 1;
    for (Index c = 0; c <= end; ++c) {
      const Point here = corners[c], next = corners[std::min(c + 1, end)], after = corners[std::min(c + 2, end)];
      step.push_back({next.x - here.x, next.y - here.y});
      normal.push_back({after.x - here.x, after.y - here.y});
      clearances.push_back(clearance);
      distance.push_back(static_cast<double>(c));
      stop.push_back(end);
      lift.push_back(end + 1);
      is_short[c] = random() % 5 == 0;
    }
    last = goal = {static_cast<Index>(waypoints) - 1};
    last_corner = {end};
    level.assign(waypoints, 0);
    speed.assign(waypoints, 1);
    yaw.assign(waypoints, nan);
  }

  Routes routes() const {
    return {first,
            last,
            goal,
            first_corner,
            last_corner,
            corner,
            level,
            speed,
            yaw,
            yaw,
            {is_wait.get(), corner.size()},
            arrival,
            corners,
            step,
            normal,
            clearances,
            distance,
            {is_short.get(), corners.size()},
            stop,
            lift,
            false};
  }
};

/// Leading segments reached and cleared, and the leg, by the rules.
struct Counts {
  Index reached = 0, cleared = 0, leg = 0;

  void update(const Grid& its, Point at, Index released) {
    const auto arrives = [&](Index w) { return its.is_wait[w] || its.arrival[w].holds(at.x, at.y); };
    while (reached < released && arrives(reached + 1)) ++reached;
    const Index here = its.corner[reached];
    while (leg + 1 < its.corner[released] && here > leg && its.routes().rounding(leg).holds(at.x, at.y)) ++leg;
    for (; cleared < std::min(released, reached + 1); ++cleared) {
      const Index from = its.corner[cleared];
      if (from >= its.last_corner[0] || here < from) break;
      if (!(its.is_short[from] && here > from) && !its.routes().clearing(from).holds(at.x, at.y)) break;
    }
  }
};

}  // namespace

TEST("the progress of a robot is that of the rules in every period") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Grid grid(random, 3 + random() % 20);
    ArrivalRules rules;
    rules.trans_stopped_velocity = rules.rot_stopped_velocity = 1;
    RouteFollower follower(1, rules);
    follower.adopt(grid.routes(), {});
    Counts expected;
    Point at = grid.corners[0];
    Index released = 0;
    for (int period = 0; period < 400; ++period) {
      if (share(random) < 0.1) released = std::min(released + 1, grid.last[0]);
      const Point to = grid.corners[grid.corner[std::min(expected.reached + 1, released)]];
      const double way = std::hypot(to.x - at.x, to.y - at.y), step = std::min(1.0, 0.1 * share(random) / (way + 1e-9));
      at = {at.x + (to.x - at.x) * step + 0.05 * (share(random) - 0.5),
            at.y + (to.y - at.y) * step + 0.05 * (share(random) - 0.5)};
      follower.update(0, {at.x, at.y, 0}, {0, 0}, released, 0);
      expected.update(grid, at, released);
      const Progress& progress = follower.progress(0);
      CHECK(progress.reached == expected.reached);
      CHECK(progress.cleared == expected.cleared);
      CHECK(progress.leg == expected.leg);
    }
    CHECK(expected.reached > 0);
  }
}
