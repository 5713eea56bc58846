#include <numbers>
#include <stdexcept>

#include "check.hpp"
#include "mrpbench_sim/noise.hpp"
#include "mrpbench_sim/plane.hpp"

using namespace mrpbench::sim;

namespace {

const Drive kDrive{{0.5, 2.0}, {2.5, 3.2}, 0.16};
constexpr double kRadius = 0.12, kPeriod = 0.05;

/// A square room around the origin.
std::vector<Segment> room(double half) {
  const std::vector<Point> corners{{-half, -half}, {-half, half}, {half, half}, {half, -half}};
  std::vector<Segment> walls;
  for (std::size_t k = 0; k < 4; ++k) walls.push_back({corners[k], corners[(k + 1) % 4]});
  return walls;
}

Plane plane(std::vector<Segment> walls, std::vector<Pose> poses, std::vector<double> movers = {}, Chance chance = {}) {
  std::vector<double> radius(poses.size(), kRadius);
  radius.insert(radius.end(), movers.begin(), movers.end());
  std::vector<Drive> drives(poses.size(), kDrive);
  return Plane(std::move(walls), radius, drives, std::move(poses), kPeriod, chance);
}

/// Robots on a lattice.
std::vector<Pose> lattice(int side, double spacing) {
  std::vector<Pose> poses;
  for (int i = 0; i < side * side; ++i) {
    poses.push_back({(i % side - (side - 1) / 2.0) * spacing, (i / side - (side - 1) / 2.0) * spacing, 0.7 * i});
  }
  return poses;
}

std::vector<Twist> commands(std::size_t count, std::uint64_t period) {
  std::vector<Twist> made;
  for (std::size_t i = 0; i < count; ++i) {
    Draws draws(99, i, period / 20);
    made.push_back({draws.uniform() - 0.2, 4 * (draws.uniform() - 0.5)});
  }
  return made;
}

bool operator==(const Pose& a, const Pose& b) {
  return a.x == b.x && a.y == b.y && a.yaw == b.yaw;
}

}  // namespace

TEST("many robots in a small room do not overlap, and all their contacts are reported") {
  const double half = 1.2;
  Plane crowd = plane(room(half), lattice(8, 0.27));
  std::size_t touches = 0;
  for (std::uint64_t period = 0; period < 400; ++period) {
    crowd.step(commands(64, period), {});
    const auto& poses = crowd.poses();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      CHECK(std::max(std::abs(poses[i].x), std::abs(poses[i].y)) <= half - kRadius + kTolerance);
      for (std::size_t j = 0; j < i; ++j) {
        CHECK(length(Point{poses[i].x - poses[j].x, poses[i].y - poses[j].y}) >= 2 * kRadius - kTolerance);
      }
    }
    CHECK(std::is_sorted(crowd.touches().begin(), crowd.touches().end()));
    for (const Touch& it : crowd.touches()) {
      if (it.other < 0) continue;
      CHECK(it.robot < it.other);
      const Pose &a = poses[static_cast<std::size_t>(it.robot)], &b = poses[static_cast<std::size_t>(it.other)];
      CHECK(length(Point{a.x - b.x, a.y - b.y}) < 2 * kRadius + 4 * 0.5 * kPeriod);
    }
    touches += crowd.touches().size();
  }
  CHECK(touches > 1000);
}

TEST("robots far apart do not influence each other, bit by bit, nor does their number") {
  std::vector<Pose> poses = lattice(3, 0.4);
  for (Chance chance : {Chance{}, Chance{0.05, 0.1, 42}}) {
    std::vector<Pose> more = poses;
    for (int i = 0; i < 500; ++i) more.push_back({100.0 + i, 50, 0.1 * i});
    Plane few = plane(room(0.7), poses, {}, chance), many = plane(room(0.7), more, {}, chance);
    for (std::uint64_t period = 0; period < 200; ++period) {
      few.step(commands(poses.size(), period), {});
      many.step(commands(more.size(), period), {});
    }
    for (std::size_t i = 0; i < poses.size(); ++i) CHECK(few.poses()[i] == many.poses()[i]);
  }
}

TEST("movers push, are not pushed, and are absent at first") {
  Plane it = plane({}, {{0, 0, 0}}, {0.3});
  it.step(std::vector<Twist>{{0, 0}}, {});
  CHECK(it.touches().empty() && it.poses()[0].x == 0);
  for (int period = 1; period <= 100; ++period) {
    it.step(std::vector<Twist>{{0, 0}}, std::vector<Point>{{-0.6 + 0.01 * period, 0}});
  }
  CHECK(std::abs(it.poses()[0].x - (0.4 + 0.3 + kRadius)) <= 1e-9);
  CHECK(it.touches() == (std::vector<Touch>{{0, 1}}));
}

TEST("a push propagates through a row of robots") {
  Plane it = plane({}, {{0, 0, 0}, {0.3, 0, 0}, {0.6, 0, 0}}, {0.3});
  for (int period = 1; period <= 2500; ++period) {  // slowly: a fast push does not get through in one period
    it.step(std::vector<Twist>(3), std::vector<Point>{{-0.6 + 0.0002 * period, 0}});
  }
  for (int i = 0; i < 3; ++i) {
    const double wanted = -0.1 + 0.3 + kRadius + 2 * kRadius * i;
    CHECK(std::abs(it.poses()[static_cast<std::size_t>(i)].x - wanted) < 0.001);
  }
  CHECK(it.touches() == (std::vector<Touch>{{0, 1}, {0, 3}, {1, 2}}));
}

TEST("within one period a push propagates to robots that did not overlap at first") {
  Plane it = plane({}, {{0, 0, 0}, {0.22, 0, 0}, {0.465, 0, 0}});
  it.step(std::vector<Twist>(3), {});
  CHECK(it.touches() == (std::vector<Touch>{{0, 1}, {1, 2}}));
  CHECK(it.poses()[2].x > 0.467);
}

TEST("a robot that drives into a wall stops, and its twist is that over ground") {
  Plane it = plane(room(0.5), {{0, 0, 0}});
  for (int period = 0; period < 60; ++period) it.step(std::vector<Twist>{{0.4, 0}}, {});
  CHECK(std::abs(it.poses()[0].x - (0.5 - kRadius)) <= 1e-9);
  CHECK(std::abs(it.twists()[0].ahead) < 1e-9);
}

TEST("a robot in the same place as another one, or on a wall, is pushed away") {
  Plane two = plane({}, {{0, 0, 0}, {0, 0, 0}});
  two.step(std::vector<Twist>(2), {});
  CHECK(std::abs(two.poses()[1].x - two.poses()[0].x - 2 * kRadius) <= kTolerance);
  Plane one = plane({{{0, 1}, {0, -1}}}, {{0, 0, 0}});  // solid on the left: at positive x
  one.step(std::vector<Twist>(1), {});
  CHECK(std::abs(one.poses()[0].x + kRadius) <= kTolerance);
}

TEST("slip shortens paths by its mean and bends straight lines") {
  const Chance chance{0.1, 0, 5};
  std::vector<Pose> poses;
  for (int i = 0; i < 50; ++i) poses.push_back({0, 10.0 * i, 0});
  Plane it = plane({}, poses, {}, chance);
  double way = 0, turned = 0;
  std::vector<Pose> last = poses;
  for (int period = 0; period < 200; ++period) {
    it.step(std::vector<Twist>(50, Twist{0.4, 0}), {});
    for (std::size_t i = 0; i < 50; ++i) {
      way += length(Point{it.poses()[i].x - last[i].x, it.poses()[i].y - last[i].y});
      turned += std::abs(it.poses()[i].yaw - last[i].yaw);
    }
    last = it.poses();
  }
  const double ramp = 0.4 * 0.4 / (2 * 2.5);
  CHECK(std::abs(way / (50 * (200 * kPeriod * 0.4 - ramp)) - 0.9) < 0.002);
  CHECK(turned > 1);
}

TEST("actuation noise has the deviation that was asked for") {
  Plane it = plane({}, {{0, 0, 0}}, {}, {0, 0.05, 9});
  double sum = 0, squares = 0;
  const int periods = 20'000;
  for (int period = 0; period < periods; ++period) {
    it.step(std::vector<Twist>{{0.2, 0}}, {});
    if (period < 20) continue;
    const double error = it.twists()[0].ahead / 0.2 - 1;
    sum += error;
    squares += error * error;
  }
  CHECK(std::abs(sum / periods) < 0.002);
  CHECK(std::abs(std::sqrt(squares / periods) - 0.05) < 0.002);
}

TEST("draws are uniform, and those of different robots, periods and seeds differ") {
  double sum = 0;
  for (std::uint64_t i = 0; i < 10'000; ++i) sum += Draws(1, i, 0).uniform();
  CHECK(std::abs(sum / 10'000 - 0.5) < 0.01);
  const double one = Draws(1, 2, 3).uniform();
  CHECK(one == Draws(1, 2, 3).uniform());
  CHECK(one != Draws(2, 2, 3).uniform() && one != Draws(1, 3, 3).uniform() && one != Draws(1, 2, 4).uniform());
}

TEST("invalid data are refused") {
  const auto refused = [](double period, Chance chance, double radius, Drive drive) {
    return check::throws<std::invalid_argument>([&] { Plane({}, {radius}, {drive}, {{0, 0, 0}}, period, chance); });
  };
  CHECK(!refused(kPeriod, {}, kRadius, kDrive));
  CHECK(refused(0, {}, kRadius, kDrive));
  CHECK(refused(kPeriod, {0.6, 0, 0}, kRadius, kDrive));
  CHECK(refused(kPeriod, {0, -1, 0}, kRadius, kDrive));
  CHECK(refused(kPeriod, {}, 0, kDrive));
  CHECK(refused(kPeriod, {}, kRadius, {{0.5, 2}, {0, 3}, 0.16}));
  Plane it = plane({}, {{0, 0, 0}});
  CHECK(check::throws<std::invalid_argument>([&] { it.step(std::vector<Twist>{{std::nan(""), 0}}, {}); }));
  CHECK(check::throws<std::invalid_argument>([&] { it.step(std::vector<Twist>(2), {}); }));
}
