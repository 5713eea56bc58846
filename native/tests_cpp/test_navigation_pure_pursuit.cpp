#include <cmath>
#include <random>
#include <vector>

#include "check.hpp"
#include "mrpbench_navigation/pure_pursuit.hpp"
#include "mrpbench_navigation/routes.hpp"

using namespace mrpbench::navigation;

namespace {

bool near(Point one, Point other) {
  return std::hypot(one.x - other.x, one.y - other.y) < 1e-9;
}

Point on(const std::vector<Point>& path, Point robot, double distance) {
  return carrot(path[0], std::span(path).subspan(1), robot, distance);
}

double length(const std::vector<Point>& path, double enough) {
  return path_length(path[0], std::span(path).subspan(1), enough);
}

}  // namespace

TEST("the carrot lies on the path at the distance asked for") {
  CHECK(near(on({{0, 0}, {1, 0}, {1, 1}}, {0, 0}, 0.5), {0.5, 0}));
  CHECK(near(on({{0.2, 0}, {1, 0}, {1, 1}}, {0.2, 0.3}, 0.5), {0.6, 0}));
  CHECK(near(on({{0.9, 0}, {1, 0}, {1, 1}}, {0.9, 0}, 0.5), {1, std::sqrt(0.24)}));
}

TEST("beyond the end the path goes on straight") {
  CHECK(near(on({{0.8, 0}, {1, 0}}, {0.9, 0}, 0.5), {1.4, 0}));
  CHECK(near(on({{0.8, 0}, {1, 0}, {1, 0}}, {0.9, 0}, 0.5), {1.4, 0}));
}

TEST("a path that begins too far away is entered at its beginning") {
  CHECK(near(on({{2, 0}, {3, 0}}, {0, 0}, 0.5), {2, 0}));
  CHECK(near(on({{1, 1}}, {1, 1}, 0.5), {1, 1}));
}

TEST("the carrot is at the lookahead distance on any path that begins near the robot") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-2, 2), share(0, 0.99), angle(-3, 3), metres(0.05, 1);
  for (int i = 0; i < 1000; ++i) {
    const Point robot{coordinate(random), coordinate(random)};
    const double distance = metres(random), away = share(random) * distance, yaw = angle(random);
    std::vector<Point> path{{robot.x + away * std::cos(yaw), robot.y + away * std::sin(yaw)}};
    for (int k = 0; k <= i % 4; ++k) path.push_back({coordinate(random), coordinate(random)});
    const Point found = on(path, robot, distance);
    CHECK(std::abs(std::hypot(found.x - robot.x, found.y - robot.y) - distance) < 1e-6);
  }
}

TEST("length is counted as far as needed") {
  const std::vector<Point> path{{0, 0}, {1, 0}, {1, 1}, {5, 1}};
  CHECK(length(path, INFINITY) == 6);
  CHECK(length(path, 1.5) >= 1.5 && length(path, 1.5) <= 2);
  CHECK(length({{3, 3}}, 1) == 0);
}

TEST("from the stopping speed a robot stops in time and no sooner") {
  for (const double distance : {0.0, 0.01, 0.5, 5.0}) {
    for (const double acceleration : {0.1, 1.0, 5.0}) {
      const double period = 0.05, speed = stopping_speed(distance, acceleration, period);
      CHECK(std::abs(speed * period + speed * speed / (2 * acceleration) - distance) < 1e-9);
    }
  }
}

TEST("a step is beyond a bound exactly where its length as hypot rounds it is") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> metres(0, 3), yaw(-4, 4), exponent(-18, 0);
  for (int i = 0; i < 100000; ++i) {
    const double bound = metres(random), angle = yaw(random);
    const double far = bound + (i % 3 - 1) * std::pow(10, exponent(random));  // mostly at the bound within rounding
    const double dx = far * std::cos(angle), dy = far * std::sin(angle), length = std::hypot(dx, dy);
    CHECK((beyond(dx, dy, bound) < 0) == (length < bound));
    CHECK((beyond(dx, dy, bound) <= 0) == (length <= bound));
  }
  CHECK(beyond(1, 2, INFINITY) < 0);
}
