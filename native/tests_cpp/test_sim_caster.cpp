#include <limits>
#include <numbers>
#include <stdexcept>

#include "check.hpp"
#include "mrpbench_sim/caster.hpp"
#include "mrpbench_sim/noise.hpp"

using namespace mrpbench::sim;

namespace {

struct Scene {
  std::vector<Segment> walls;
  std::vector<Pose> poses;
  std::vector<Point> centres;
  std::vector<double> radius;
};

/// Boxes and discs at random in a square; some of the discs are movers.
Scene scene(std::uint64_t seed, int boxes, int robots, int movers, double size) {
  Draws draws(seed, 0, 0);
  const auto within = [&](double low, double high) { return low + (high - low) * draws.uniform(); };
  Scene made;
  for (int i = 0; i < boxes; ++i) {
    const double x = within(-size, size), y = within(-size, size), yaw = within(0, 6), a = within(0.05, 2), b = 0.3;
    const Point along = Point{std::cos(yaw), std::sin(yaw)} * a, left = Point{-std::sin(yaw), std::cos(yaw)} * b;
    const std::vector<Point> corners{{x, y}, Point{x, y} + along, Point{x, y} + along + left, Point{x, y} + left};
    for (std::size_t k = 0; k < 4; ++k) made.walls.push_back({corners[k], corners[(k + 1) % 4]});
  }
  for (int i = 0; i < robots + movers; ++i) {
    made.centres.push_back({within(-size, size), within(-size, size)});
    made.radius.push_back(within(0.05, 0.4));
    if (i < robots) made.poses.push_back({made.centres.back().x, made.centres.back().y, within(-4, 4)});
  }
  return made;
}

/// Tests every beam against every object.
double brute_force(const Scene& it, const Lidar& lidar, int robot, int beam) {
  const Pose pose = it.poses[static_cast<std::size_t>(robot)];
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  const Point origin{pose.x + c * lidar.mount.x - s * lidar.mount.y, pose.y + s * lidar.mount.x + c * lidar.mount.y};
  const double angle = pose.yaw + beam * (2 * std::numbers::pi / lidar.beams);
  const Point ray{std::cos(angle), std::sin(angle)};
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& wall : it.walls) {
    const Point along = wall.end - wall.start, offset = wall.start - origin;
    const double turn = along.x * ray.y - along.y * ray.x, area = along.x * offset.y - along.y * offset.x;
    const double share = (ray.x * offset.y - ray.y * offset.x) / turn;
    if (area > 0 && turn > 0 && share >= -1e-9 && share <= 1 + 1e-9) nearest = std::min(nearest, area / turn);
  }
  for (std::size_t i = 0; i < it.centres.size(); ++i) {
    if (static_cast<int>(i) == robot) continue;
    const Point offset = it.centres[i] - origin;
    const double ahead = dot(offset, ray), beside = offset.x * ray.y - offset.y * ray.x;
    const double squared = it.radius[i] * it.radius[i] - beside * beside;
    if (squared < 0 || ahead + std::sqrt(squared) < 0) continue;
    nearest = std::min(nearest, std::max(ahead - std::sqrt(squared), 0.0));
  }
  const bool returns = nearest >= lidar.min_range && nearest <= lidar.range;
  return returns ? nearest : std::numeric_limits<double>::infinity();
}

bool same(double a, double b) {
  return a == b || std::abs(a - b) <= 1e-9;
}

std::vector<double> scan(const Scene& it, const Lidar& lidar, const std::vector<int>& robots) {
  std::vector<double> ranges(robots.size() * static_cast<std::size_t>(lidar.beams));
  Caster(it.walls, lidar).scan(robots, it.poses, it.centres, it.radius, {}, {}, ranges);
  return ranges;
}

void compare(const Scene& it, const Lidar& lidar, int* returns) {
  std::vector<int> robots;
  for (std::size_t i = 0; i < it.poses.size(); ++i) robots.push_back(static_cast<int>(i));
  const std::vector<double> ranges = scan(it, lidar, robots);
  int wrong = 0;
  for (const int robot : robots) {
    for (int beam = 0; beam < lidar.beams; ++beam) {
      const double found = ranges[static_cast<std::size_t>(robot * lidar.beams + beam)];
      wrong += !same(found, brute_force(it, lidar, robot, beam));
      *returns += std::isfinite(found);
    }
  }
  CHECK(wrong == 0);
}

}  // namespace

TEST("scans are the same as by testing every beam against every object") {
  int returns = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    compare(scene(seed, 1 + static_cast<int>(seed), 6, 3, 6), {360, 3.5, 0.12, {-0.032, 0.01}}, &returns);
  }
  CHECK(returns > 20'000);
}

TEST("from a single beam to twenty thousand, and for long ranges") {
  int returns = 0;
  for (const int beams : {1, 2, 3, 4, 7, 1000, 20'000}) {
    compare(scene(7, 30, 4, 2, 8), {beams, 3.5, 0.12, {}}, &returns);
    compare(scene(8, 60, 4, 2, 40), {beams, 60, 0, {0.1, 0.1}}, &returns);
  }
  CHECK(returns > 20'000);
}

TEST("in a square room every beam returns, also from the corners") {
  const std::vector<Point> corners{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}};  // clockwise: solid outside
  Scene room;
  for (std::size_t k = 0; k < 4; ++k) room.walls.push_back({corners[k], corners[(k + 1) % 4]});
  room.poses = {{0, 0, 0}};
  room.centres = {{0, 0}};
  room.radius = {0.1};
  const std::vector<double> ranges = scan(room, {8, 3.5, 0.12, {}}, {0});
  for (std::size_t i = 0; i < 8; ++i) CHECK(same(ranges[i], i % 2 ? std::numbers::sqrt2 : 1.0));
}

TEST("a mover around the sensor blinds it, and absent discs are not seen") {
  Scene it;
  const double infinity = std::numeric_limits<double>::infinity();
  it.poses = {{0, 0, 0}};
  it.centres = {{0, 0}, {infinity, infinity}};
  it.radius = {0.1, 0.3};
  for (const double range : scan(it, {16, 3.5, 0.12, {}}, {0})) CHECK(range == infinity);
  it.centres[1] = {0.1, 0.1};
  for (const double range : scan(it, {16, 3.5, 0.12, {}}, {0})) CHECK(range == infinity);
  for (const double range : scan(it, {16, 3.5, 0, {}}, {0})) CHECK(range == 0);
}

TEST("a scan does not depend on which others are taken with it") {
  const Scene it = scene(3, 40, 30, 4, 6);
  const Lidar lidar;
  std::vector<int> all;
  for (int i = 0; i < 30; ++i) all.push_back(i);
  const std::vector<double> together = scan(it, lidar, all);
  for (const int robot : all) {
    const std::vector<double> alone = scan(it, lidar, {robot});
    CHECK(std::equal(alone.begin(), alone.end(), together.begin() + robot * lidar.beams));
  }
}

TEST("invalid lidars are refused") {
  CHECK(check::throws<std::invalid_argument>([] { Caster({}, {0, 3.5, 0.12, {}}); }));
  CHECK(check::throws<std::invalid_argument>([] { Caster({}, {360, 0, 0.12, {}}); }));
}
