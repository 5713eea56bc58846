#include <cmath>
#include <random>

#include "check.hpp"
#include "mrpbench_local/costmap/footprint.hpp"
#include "mrpbench_local/dwb/dwb.hpp"

using namespace mrpbench::local;

namespace {

bool near(double a, double b, double slack = 1e-9) {
  return std::abs(a - b) <= slack;
}

}  // namespace

TEST("samples are those of Nav2: evenly spaced, with an exact zero between the signs") {
  const auto speeds = samples(0, 0, 0.22, 2.5, -2.5, 1.7, 20);
  CHECK(speeds.size() == 20 && speeds.front() == 0 && speeds.back() == 0.22);
  const auto turns = samples(0, -1, 1, 3.2, -3.2, 1.7, 20);
  CHECK(turns.size() == 21 && turns[10] == 0);
  CHECK(samples(0, 0, 0, 2.5, -2.5, 1.7, 5).size() == 1);
  const auto window = samples(0.1, 0, 0.22, 1, -1, 0.05, 3);
  CHECK(window.size() == 3 && near(window[0], 0.05) && near(window[1], 0.1) && near(window[2], 0.15));
}

TEST("there are 419 trajectories, none of which stands still") {
  MotionOptions motion;
  motion.max_vel_x = motion.max_speed_xy = 0.22;
  Trajectories all;
  all.generate(motion, {}, {}, 1e9);
  CHECK(all.size() == 419);
  CHECK(all.twist(0).ahead == 0 && all.twist(0).turn == -1);
  for (std::size_t i = 0; i < all.size(); ++i) CHECK(all.twist(i).ahead != 0 || all.twist(i).turn != 0);
}

TEST("last poses are the same as by walking, from any state") {
  MotionOptions motion;
  Trajectories all;
  for (const Twist current : {Twist{0, 0}, Twist{0.2, -0.7}, Twist{0.11, 0.9}}) {
    all.generate(motion, {1, 2, 0.7}, current, 1e9);
    all.compute_ends();
    for (std::size_t i = 0; i < all.size(); ++i) {
      Pose last;
      int poses = 0;
      all.walk(i, [&](Pose pose) {
        last = pose;
        ++poses;
        return true;
      });
      CHECK(poses == all.steps(all.twist(i)) + 2);
      const Pose end = all.end(i);
      CHECK(near(last.x, end.x, 1e-12) && near(last.y, end.y, 1e-12) && near(last.yaw, end.yaw, 1e-12));
      CHECK(near(all.heading(i).x, std::cos(end.yaw), 1e-12) && near(all.heading(i).y, std::sin(end.yaw), 1e-12));
    }
  }
}

TEST("cells that follow from estimates are those of the exact last poses") {
  std::mt19937 draw(5);
  const auto within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(draw); };
  Trajectories all;  // more states than there are estimates that are kept
  for (int round = 0; round < 300; ++round) {
    MotionOptions motion;
    motion.max_vel_x = motion.max_speed_xy = within(0.05, 2);
    motion.min_vel_x = round % 3 == 0 ? -motion.max_vel_x : 0;
    motion.max_vel_theta = within(0.1, 4);
    motion.acc_lim_x = within(0.2, 3);
    motion.decel_lim_x = -within(0.2, 3);
    motion.acc_lim_theta = within(0.3, 4);
    motion.decel_lim_theta = -within(0.3, 4);
    motion.vx_samples = 2 + round % 9;
    motion.vtheta_samples = 1 + round % 14;
    motion.sim_time = within(0.1, 3);
    motion.discretize_by_time = round % 7 == 0;
    motion.limited = round % 5 == 0;
    // Half of the robots stand on the border of cells and along it, where no estimate can decide.
    const bool on_border = round % 2 == 0;
    const Pose start{on_border ? 1.5 : within(-50, 50), on_border ? 2 : within(-50, 50), on_border ? 0 : within(-4, 4)};
    const Twist current{on_border ? 0 : within(0, 0.3), on_border ? 0 : within(-0.5, 0.5)};
    const Frame frame{60, 60, 0.05, {static_cast<int>(start.x * 20) - 30, static_cast<int>(start.y * 20) - 30}};
    for (const double distance : {0.0, 0.325}) {
      all.generate(motion, start, current, 1e9);
      all.generate(motion, {start.x, start.y, start.yaw + 1}, current, 1e9);
      all.generate(motion, start, current, 1e9);  // now by an estimate from before
      std::vector<Pose> ends;                     // of each alone
      for (std::size_t i = 0; i < all.size(); ++i) ends.push_back(all.end(i));
      std::vector<int> x, y;
      const auto [low, high] = all.cells_ahead(frame, distance, x, y);
      all.compute_ends();
      for (std::size_t i = 0; i < all.size(); ++i) {
        const Pose end = all.end(i);
        CHECK(end == ends[i]);
        const Cell c = frame.cell(Point{end.x, end.y} + all.heading(i) * distance);
        CHECK((Cell{x[i], y[i]} == c));
        CHECK(c.x >= low.x && c.y >= low.y && c.x <= high.x && c.y <= high.y);
      }
    }
  }
}

TEST("the length of a straight trajectory at full speed is speed times duration") {
  MotionOptions motion;
  motion.max_vel_x = motion.max_speed_xy = 0.2;
  Trajectories all;
  all.generate(motion, {}, {0.2, 0}, 1e9);
  bool found = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all.twist(i).ahead != 0.2 || all.twist(i).turn != 0) continue;
    found = true;
    CHECK(near(all.end(i).x, 0.34) && near(all.end(i).y, 0) && all.steps(all.twist(i)) == 7);
  }
  CHECK(found);
}

TEST("a limit of speed holds for all samples") {
  const MotionOptions motion;
  Trajectories all;
  all.generate(motion, {}, {0.2, 0}, 0.1);
  for (std::size_t i = 0; i < all.size(); ++i) CHECK(all.twist(i).ahead <= 0.1);
}

TEST("a path is driven to a point beyond its end until the robot is there") {
  const Frame frame{60, 60, 0.05, {-30, -30}};
  PathGrid path;
  const std::vector<Point> rest{{0.5, 0.0}, {0.5, 0.4}};
  path.take(frame, {0.0, 0.0}, {0.0, 0.0}, rest, {.beyond_end = 0.35});
  CHECK(near(path.left(), 0.9));
  CHECK(near(path.goal().x, 0.5) && near(path.goal().y, 0.75));
  const std::vector<Point> last{{0.5, 0.4}};
  path.take(frame, {0.5, 0.36}, {0.5, 0.36}, last, {.beyond_end = 0.35});
  CHECK(near(path.left(), 0.04) && near(path.goal().y, 0.4));
  path.take(frame, {0.0, 0.0}, {0.0, 0.0}, rest, {.beyond_end = 0});
  CHECK(near(path.goal().x, 0.5) && near(path.goal().y, 0.4));
  path.take(frame, {0.0, 0.0}, {0.0, 0.0}, rest, {.prune_distance = 0.3});
  CHECK(std::isinf(path.left()) && near(path.goal().x, 0.3));
}

TEST("distances to the path are counted along rows and columns") {
  const Frame frame{10, 8, 1.0, {0, 0}};
  PathGrid path;
  const std::vector<Point> rest{{4.5, 1.5}, {4.5, 5.5}};
  path.take(frame, {1.5, 1.5}, {1.5, 1.5}, rest, {.prune_distance = 100, .shorten = false});
  for (int corner = 0; corner < 80; ++corner) {  // also of windows beside the path, and beyond the frame
    const Cell low{corner % 10 - 1, corner / 10 - 1};
    path.spread(frame, low, {low.x + corner % 7, low.y + corner % 5});
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 10; ++x) {
        int nearest = 1000;
        for (const Cell& c : path.cells()) nearest = std::min(nearest, std::abs(c.x - x) + std::abs(c.y - y));
        CHECK(path.distance(frame, {x, y}) == nearest);
      }
    }
  }
}
