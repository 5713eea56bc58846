#include <limits>
#include <set>

#include "check.hpp"
#include "mrpbench_sim/neighbours.hpp"
#include "mrpbench_sim/noise.hpp"

using namespace mrpbench::sim;

namespace {

std::vector<Point> scattered(std::uint64_t seed, int count, double size) {
  Draws draws(seed, 1, 2);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) points.push_back({size * (draws.uniform() - 0.5), size * (draws.uniform() - 0.5)});
  return points;
}

std::vector<Segment> lines(std::uint64_t seed, int count, double size) {
  const std::vector<Point> ends = scattered(seed, 2 * count, size);
  std::vector<Segment> made;
  for (std::size_t i = 0; i < ends.size(); i += 2) made.push_back({ends[i], ends[i + 1]});
  return made;
}

}  // namespace

TEST("hashing finds every point in reach once") {
  for (const int count : {30, 100, 300, 1000}) {
    const std::vector<Point> points = scattered(5, count, 20);
    for (const double cell : {0.05, 0.3, 0.5, 1.0, 3.0}) {
      DiscHash hash(cell);
      hash.build(points);
      for (const Point& centre : scattered(6, 50, 24)) {
        std::multiset<int> found;
        hash.near(centre, 1.5, [&](int index) { found.insert(index); });
        for (std::size_t i = 0; i < points.size(); ++i) {
          const auto times = found.count(static_cast<int>(i));
          CHECK(length(points[i] - centre) <= 1.5 ? times == 1 : times <= 1);
        }
      }
    }
  }
}

TEST("absent points are not hashed") {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Point> points{{infinity, infinity}, {0, 0}, {std::nan(""), 0}, {1e30, 0}};
  DiscHash hash(1);
  hash.build(points);
  int visits = 0;
  hash.near({0, 0}, 5, [&](int index) { visits += index == 1 ? 1 : 100; });
  CHECK(visits == 1);
}

TEST("buckets hold every segment in reach, in order") {
  for (const double size : {4.0, 60.0, 1e5}) {
    const std::vector<Segment> walls = lines(11, 60, size);
    const SegmentBuckets buckets(walls, 1.2, 0.5);
    std::vector<Point> places = scattered(12, 100, 1.3 * size);
    for (const Segment& wall : walls) places.push_back(wall.start + Point{0.7, 0.9});
    for (const Point& place : places) {
      const auto near = buckets.near(place);
      CHECK(std::is_sorted(near.begin(), near.end()));
      for (std::size_t i = 0; i < walls.size(); ++i) {
        if (length(gap(walls[i], place)) > 1.2) continue;
        CHECK(std::binary_search(near.begin(), near.end(), static_cast<std::int32_t>(i)));
      }
    }
  }
  CHECK(SegmentBuckets({}, 1, 1).near({0, 0}).empty());
}

TEST("lists contain all contacts while discs move") {
  const int robots = 60;
  std::vector<double> radius(robots, 0.2);
  radius.push_back(0.25);  // a mover
  Neighbours neighbours(lines(13, 30, 8), radius, robots);
  std::vector<Point> centres = scattered(14, robots + 1, 8);
  const std::vector<Segment> walls = lines(13, 30, 8);
  int touches = 0;
  for (std::uint64_t step = 0; step < 60; ++step) {
    const std::vector<Point> moves = scattered(100 + step, robots + 1, 0.1);
    for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = centres[i] + moves[i];
    neighbours.refresh(centres);
    for (int robot = 0; robot < robots; ++robot) {
      const Point centre = centres[static_cast<std::size_t>(robot)];
      const auto discs = neighbours.discs(robot), near = neighbours.walls(robot);
      CHECK(std::is_sorted(discs.begin(), discs.end()));
      for (int other = 0; other <= robots; ++other) {
        const double spacing = neighbours.radius(robot) + neighbours.radius(other);
        if (other == robot || length(centres[static_cast<std::size_t>(other)] - centre) > spacing) continue;
        ++touches;
        CHECK(std::binary_search(discs.begin(), discs.end(), other));
      }
      for (std::size_t i = 0; i < walls.size(); ++i) {
        if (length(gap(walls[i], centre)) > 0.2) continue;
        CHECK(std::binary_search(near.begin(), near.end(), static_cast<int>(i)));
      }
    }
  }
  CHECK(touches > 1000);
}
