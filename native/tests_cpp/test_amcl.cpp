#include <numbers>
#include <stdexcept>

#include "check.hpp"
#include "mrpbench_amcl/estimate.hpp"
#include "mrpbench_amcl/fleet.hpp"
#include "mrpbench_amcl/likelihood_field.hpp"
#include "mrpbench_amcl/motion.hpp"
#include "mrpbench_amcl/resampling.hpp"

using namespace mrpbench::amcl;
using mrpbench::sim::Draws;
using mrpbench::sim::Segment;

namespace {

constexpr double kPi = std::numbers::pi;

bool near(double a, double b, double by) {
  return std::abs(a - b) <= by;
}

std::vector<Particle> at(Pose pose, std::size_t count) {
  return std::vector<Particle>(count, Particle{pose, 1.0 / static_cast<double>(count)});
}

double deviation(const std::vector<Particle>& particles, auto&& value) {
  double sum = 0, squares = 0;
  for (const Particle& it : particles) {
    sum += value(it.pose);
    squares += value(it.pose) * value(it.pose);
  }
  const double count = static_cast<double>(particles.size()), mean = sum / count;
  return std::sqrt(squares / count - mean * mean);
}

/// Two walls that form a corner, solid on their left.
const std::vector<Segment> kCorner{{{2, 3}, {2, -3}}, {{-3, 2}, {2, 2}}};

}  // namespace

TEST("without noise particles follow odometry, forwards and backwards") {
  Parameters exact;
  exact.alpha1 = exact.alpha2 = exact.alpha3 = exact.alpha4 = 0;
  for (const Pose step : {Pose{0.3, 0.1, 0.5}, Pose{-0.3, 0.02, -0.1}, Pose{0, 0, 1.0}}) {
    auto particles = at({1, 2, 2.5}, 3);
    Draws draws(1, 0, 0);
    move(particles, step, exact, draws);
    const Pose wanted = composed({1, 2, 2.5}, step);
    for (const Particle& it : particles) {
      CHECK(near(it.pose.x, wanted.x, 1e-12) && near(it.pose.y, wanted.y, 1e-12));
      CHECK(near(wrapped(it.pose.yaw - wanted.yaw), 0, 1e-12));
    }
  }
}

TEST("noise has the variances of the odometry model") {
  Parameters noisy;
  noisy.alpha1 = 0.1;
  noisy.alpha2 = 0.0;
  noisy.alpha3 = 0.04;
  noisy.alpha4 = 0.0;
  Draws draws(2, 0, 0);
  auto straight = at({0, 0, 0}, 20000);
  move(straight, {0.5, 0, 0}, noisy, draws);
  CHECK(near(deviation(straight, [](Pose p) { return p.x; }), 0.5 * 0.2, 0.002));
  CHECK(deviation(straight, [](Pose p) { return p.yaw; }) < 1e-12);
  auto turning = at({0, 0, 0}, 20000);
  move(turning, {0, 0, 0.8}, noisy, draws);
  CHECK(near(deviation(turning, [](Pose p) { return p.yaw; }), 0.8 * std::sqrt(0.1), 0.005));
  noisy.alpha1 = 0;
  noisy.alpha2 = 0.01;
  auto skewed = at({0, 0, 0}, 20000);
  move(skewed, {0.5, 0, 0}, noisy, draws);  // both turns err with the way
  CHECK(near(deviation(skewed, [](Pose p) { return p.yaw; }), std::sqrt(2.0) * 0.05, 0.001));
}

TEST("the likelihood of a hit depends on its distance from the nearest wall") {
  const Parameters parameters;
  const LikelihoodField field(kCorner, 0.05, parameters);
  Draws draws(3, 0, 0);
  for (int i = 0; i < 500; ++i) {
    const Point point{8 * draws.uniform() - 4, 8 * draws.uniform() - 4};
    // the middle of the square that the point is in; the field begins 2 m left of and below everything
    const Point cell{std::floor((point.x + 5) / 0.05) * 0.05 - 5 + 0.025,
                     std::floor((point.y + 5) / 0.05) * 0.05 - 5 + 0.025};
    double nearest = 2.0;
    for (const Segment& it : kCorner) nearest = std::min(nearest, length(mrpbench::sim::gap(it, cell)));
    const bool inside = cell.x < 4 && cell.y < 5;
    if (!inside) nearest = 2.0;
    CHECK(near(field.hit(point), 0.5 * std::exp(-nearest * nearest / 0.08), 1e-6));
  }
}

TEST("weights follow the formula for the beams that are used") {
  Parameters parameters;
  const double endless = std::numeric_limits<double>::infinity();
  const std::vector<double> ranges{1.9, endless, 0.05, 1.0};  // ahead, left, behind, right
  const Ends ends = ends_of(ranges, 3.5, 0.12, {0.1, 0}, parameters);
  CHECK(ends.points.size() == 2);
  CHECK(near(ends.points[0].x, 2.0, 1e-12) && near(ends.points[1].y, -1.0, 1e-12));
  auto particles = at({0, 0, 0}, 2);
  const double hit = LikelihoodField(kCorner, 0.05, parameters).hit({2.0, 0}) + 0.5 / 3.5;
  const double miss = LikelihoodField(kCorner, 0.05, parameters).hit({0.1, -1.0}) + 0.5 / 3.5;
  CHECK(near(LikelihoodField(kCorner, 0.05, parameters).weigh(particles, ends),
             1 + std::pow(hit, 3) + std::pow(miss, 3), 1e-6));
  parameters.independent_beams = true;
  particles = at({0, 0, 0}, 2);
  CHECK(near(LikelihoodField(kCorner, 0.05, parameters).weigh(particles, ends), hit * miss, 1e-6));
}

TEST("the product of likelihoods of many beams does not underflow") {
  Parameters parameters;
  parameters.independent_beams = true;
  parameters.max_beams = 4000;
  const Ends ends = ends_of(std::vector<double>(4000, 1.0), 100, 0.1, {}, parameters);
  std::vector<Particle> particles{{{0, 0, 0}, 0.5}, {{0.3, 0, 0}, 0.5}};
  LikelihoodField(kCorner, 0.05, parameters).weigh(particles, ends);
  CHECK(particles[0].weight + particles[1].weight > 0.4);
}

TEST("the number of particles is the quantile of chi-square over twice the error") {
  Parameters parameters;
  parameters.min_particles = 1;
  parameters.max_particles = 100000;
  parameters.pf_z = 2.326348;  // 99 %
  CHECK(particles_for(1, parameters) == 1);
  CHECK(near(particles_for(11, parameters), 23.209 / 0.1, 2));     // chi-square, 10 degrees of freedom
  CHECK(near(particles_for(101, parameters), 135.807 / 0.1, 2));   // 100 degrees of freedom
  CHECK(near(particles_for(1001, parameters), 1106.97 / 0.1, 2));  // 1000 degrees of freedom
  parameters.max_particles = 500;
  CHECK(particles_for(101, parameters) == 500);
}

TEST("particles are drawn by weight, and their number depends on their spread") {
  Parameters parameters;
  Draws draws(4, 0, 0);
  const std::vector<Particle> two{{{0.1, 0.1, 0.1}, 0.25}, {{5, 5, 1}, 0.75}};
  const auto drawn = resampled(two, parameters, 0, {}, draws);
  CHECK(drawn.size() == 500);  // two bins: the fewest
  std::size_t second = 0;
  for (const Particle& it : drawn) second += it.pose.x > 1;
  CHECK(near(static_cast<double>(second) / 500, 0.75, 0.06));
  std::vector<Particle> spread;
  for (int i = 0; i < 2000; ++i) spread.push_back({{i * 0.7, 0, 0}, 1.0 / 2000});
  CHECK(resampled(spread, parameters, 0, {}, draws).size() == 2000);  // every one in a bin of its own: the most
  const auto lost = resampled(two, parameters, 0.5, Places{{{-9, -9}}, 0.05}, draws);
  std::size_t elsewhere = 0;
  for (const Particle& it : lost) elsewhere += it.pose.x < -1;
  CHECK(near(static_cast<double>(elsewhere) / static_cast<double>(lost.size()), 0.5, 0.08));
}

TEST("the estimate is the mean of the heaviest cluster, also where yaw wraps around") {
  std::vector<Particle> particles;
  for (int i = 0; i < 10; ++i) particles.push_back({{1.0 + 0.01 * i, 2.0, i % 2 ? kPi - 0.1 : -kPi + 0.1}, 0.06});
  for (int i = 0; i < 30; ++i) particles.push_back({{6.0, 2.0, 0.0}, 0.4 / 30});
  const Estimate found = estimate(particles);
  CHECK(near(found.pose.x, 1.045, 1e-9) && near(found.pose.y, 2.0, 1e-9));
  CHECK(near(std::abs(found.pose.yaw), kPi, 1e-9));
  CHECK(near(found.covariance[8], 0.01, 1e-9));
  CHECK(near(found.covariance[0], 0.000825, 1e-9));
}

TEST("between updates the pose follows odometry in any frame") {
  Fleet fleet({}, 0.05, {}, {{1, 2, kPi / 2}}, {}, 7);
  fleet.begin(std::vector<Pose>{{10, 10, 0}});
  const Pose found = fleet.pose(0, {10.5, 10, 0.1});
  CHECK(near(found.x, 1, 1e-9) && near(found.y, 2.5, 1e-9) && near(found.yaw, kPi / 2 + 0.1, 1e-9));
}

TEST("scans of a standing robot are used once") {
  Fleet fleet(kCorner, 0.05, {}, {{0, 0, 0}}, {}, 7);
  const std::vector<Pose> odometry{{0, 0, 0}};
  const std::vector<int> robots{0};
  const std::vector<double> ranges(36, 2.0);
  fleet.begin(odometry);
  const Scans scans{robots, ranges, 3.5, 0.1, {}};
  fleet.sense(scans, odometry);
  const Pose once = fleet.pose(0, odometry[0]);
  fleet.sense(scans, odometry);
  CHECK(once.x == fleet.pose(0, odometry[0]).x);
  fleet.sense(scans, std::vector<Pose>{{0.3, 0, 0}});
  CHECK(once.x != fleet.pose(0, {0.3, 0, 0}).x);
}

TEST("invalid parameters and data are refused") {
  Parameters wrong;
  wrong.max_particles = 10;
  const auto make = [&](const Parameters& parameters, Pose pose, double resolution) {
    Fleet fleet(kCorner, resolution, {}, {pose}, parameters, 0);
  };
  CHECK(check::throws<std::invalid_argument>([&] { make(wrong, {}, 0.05); }));
  CHECK(check::throws<std::invalid_argument>([&] { make({}, {std::nan(""), 0, 0}, 0.05); }));
  CHECK(check::throws<std::invalid_argument>([&] { make({}, {}, 0); }));
  CHECK(check::throws<std::invalid_argument>([&] { make({}, {}, 1e-6); }));  // too many squares
  Fleet fleet(kCorner, 0.05, {}, {{0, 0, 0}}, {}, 0);
  CHECK(check::throws<std::invalid_argument>([&] { fleet.begin(std::vector<Pose>(2)); }));
  const std::vector<int> nobody{1};
  const std::vector<double> ranges{1.0};
  CHECK(check::throws<std::invalid_argument>(
      [&] { fleet.sense({nobody, ranges, 3.5, 0.1, {}}, std::vector<Pose>{{0, 0, 0}}); }));
}
