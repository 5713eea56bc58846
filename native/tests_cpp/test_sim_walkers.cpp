// Forces and velocities with the numbers of public implementations (lightsfm, RVO2), run once; and motion.
#include "check.hpp"
#include "mrpbench_sim/walkers.hpp"
#include "mrpbench_sim/walking_routes.hpp"

using namespace mrpbench::sim;

namespace {

bool near(Point a, Point b, double within = 1e-5) {
  return std::abs(a.x - b.x) <= within && std::abs(a.y - b.y) <= within;
}

Point force(Point other, Point velocity) {
  return social_force({{0, 0}, {1, 0}}, {other, velocity}, 2.1, 0);
}

Point chosen(Walker me, std::vector<Walker> others, Point wanted, double share) {
  std::vector<HalfPlane> planes;
  for (const Walker& it : others) planes.push_back(avoiding(me, it, 0.6, 2, 0.05, share));
  return nearest_velocity(planes, 0, 1.5, wanted);
}

}  // namespace

TEST("social forces are those of lightsfm") {
  CHECK(near(force({2, 0}, {-1, 0}), {-0.669704, 0}));
  CHECK(near(force({2, 0.2}, {-1, 0}), {-0.546099, -0.626500}));
  CHECK(near(force({2, -0.2}, {-1, 0}), {-0.546099, 0.626500}));
  CHECK(near(force({1, -1}, {0, 1}), {-0.516821, 0.516821}));
  CHECK(near(force({1, 0}, {0.5, 0}), {-0.503267, 0}));
  CHECK(near(force({0, 0.7}, {1, 0}), {0, -0.284204}));
}

TEST("people who meet head-on keep to the right") {
  CHECK(social_force({{0, 0}, {1, 0}}, {{2, 0}, {-1, 0}}, 2.1, 0.005).y < 0);
}

TEST("velocities are those of RVO2") {
  CHECK(near(chosen({{0, 0}, {1, 0}}, {{{2, 0}, {-1, 0}}}, {1, 0}, 0.5), {0.910000, -0.286182}));
  CHECK(near(chosen({{0, 0}, {1, 0}}, {{{1, -1}, {0, 1}}}, {1, 0}, 0.5), {0.717906, -0.102094}));
  CHECK(near(chosen({{1, -1}, {0, 1}}, {{{0, 0}, {1, 0}}}, {0, 1}, 0.5), {0.282094, 1.102094}));
  CHECK(near(chosen({{0, 0}, {0, 0}}, {{{0.5, 0}, {0, 0}}}, {0, 0}, 0.5), {-1, 0}));
}

TEST("contradicting velocity obstacles are violated as little as possible") {
  const Walker me{{0, 0}, {0.3, 0.1}};
  const std::vector<Walker> others = {{{0.65, 0}, {-1, 0}}, {{-0.65, 0.1}, {1, 0}}, {{0.1, -0.7}, {0, 1}}};
  std::vector<HalfPlane> planes;
  for (const Walker& it : others) planes.push_back(avoiding(me, it, 0.6, 2, 0.05, 1));
  const auto worst = [&](Point v) {
    double most = -1e9;
    for (const HalfPlane& it : planes) {
      const Point offset = it.point - v;
      most = std::max(most, it.direction.x * offset.y - it.direction.y * offset.x);
    }
    return most;
  };
  double least = 1e9;
  for (int i = -150; i <= 150; ++i) {
    for (int j = -150; j <= 150; ++j) {
      const Point v{0.01 * i, 0.01 * j};
      if (length(v) <= 1.5) least = std::min(least, worst(v));
    }
  }
  CHECK(least > 0.05);  // they contradict
  const Point found = nearest_velocity(planes, 0, 1.5, {1, 0});
  CHECK(length(found) <= 1.5 + 1e-9);
  CHECK(worst(found) <= least + 1e-3);
}

TEST("people do not overlap walls, robots or one another, whatever they want") {
  for (const bool orca : {false, true}) {
    std::vector<Segment> box = {{{0, 0}, {0, 4}}, {{0, 4}, {4, 4}}, {{4, 4}, {4, 0}}, {{4, 0}, {0, 0}}};
    std::vector<Point> places;
    for (int i = 0; i < 25; ++i) places.push_back({0.5 + 0.7 * (i % 5), 0.5 + 0.7 * (i / 5)});
    WalkerOptions options;
    options.orca = orca;
    Walkers crowd(box, std::vector<double>(25, 0.3), std::vector<double>(25, 1.3), std::vector<int>(25, -1), places,
                  options);
    std::vector<Walker> robots = {{{2.25, 0.85}, {0, 0}}};
    const std::vector<double> radius = {0.1};
    for (int period = 0; period < 300; ++period) {
      const double turn = 0.05 * period;
      const std::vector<Point> wanted(25, {1.3 * std::cos(turn), 1.3 * std::sin(turn)}), push(25);
      const std::vector<unsigned char> regard(25, Walkers::not_at_all);
      crowd.step(0.1, {wanted, push, regard}, robots, radius, 1, {});
      for (std::size_t i = 0; i < 25; ++i) {
        const Point p = crowd.places()[i];
        CHECK(p.x >= 0.3 - 2e-4 && p.x <= 3.7 + 2e-4 && p.y >= 0.3 - 2e-4 && p.y <= 3.7 + 2e-4);
        CHECK(length(p - robots[0].place) >= 0.4 - 2e-4);
        for (std::size_t j = 0; j < i; ++j) CHECK(length(p - crowd.places()[j]) >= 0.6 - 2e-4);
        CHECK(length(crowd.velocities()[i]) <= 1.3 / 0.25);
      }
    }
  }
}

TEST("a wall ahead slows orca down in the wall's horizon") {
  WalkerOptions options;
  options.orca = true;
  options.wall_horizon = 2;
  Walkers one({{{1, 5}, {1, -5}}}, {0.3}, {1.5}, {-1}, {{0, 0}}, options);
  const std::vector<Point> wanted = {{1, 0}}, push(1);
  const std::vector<unsigned char> regard(1);
  one.step(0.05, {wanted, push, regard}, {}, {}, 0, {});
  CHECK(std::abs(one.velocities()[0].x - 0.35) < 1e-9);
}

TEST("members of a group come together again") {
  Walkers two({}, {0.25, 0.25}, {1.3, 1.3}, {0, 0}, {{0, 0}, {0, 4}}, {});
  const std::vector<Point> wanted(2, {1, 0}), push(2);
  const std::vector<unsigned char> regard(2);
  for (int period = 0; period < 200; ++period) two.step(0.05, {wanted, push, regard}, {}, {}, 0, {});
  CHECK(length(two.places()[0] - two.places()[1]) < 1.6);
  CHECK(two.places()[0].x > 4);
}

TEST("routes lead straight round corners") {
  // A wall of three cells in the middle of 5 x 5, open at the top row alone.
  const std::vector<unsigned char> free = {1, 1, 1, 1, 1,  //
                                           1, 1, 0, 1, 1,  //
                                           1, 1, 0, 1, 1,  //
                                           1, 1, 0, 1, 1,  //
                                           1, 1, 0, 1, 1};
  const auto next = walking_routes(free, 5, 5, 24);
  CHECK(next[24] == 24 && next[23] == 24 && next[4] == 24);
  CHECK(next[20] == 1 || next[20] == 0 || next[20] == 6);  // up first: the goal is behind the wall
  int at = 20, legs = 0;
  while (at != 24 && legs < 10) at = next[static_cast<std::size_t>(at)], ++legs;
  CHECK(at == 24 && legs <= 4);
  CHECK(next[17] == 16 || next[17] == 18);  // from within the wall to a free cell beside it
}
