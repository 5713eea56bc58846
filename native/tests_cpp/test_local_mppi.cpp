// The numbers are those of Nav2's own tests of MPPI, of samples with equal poses; its critics have its code's defaults.
#include <cmath>

#include "check.hpp"
#include "mrpbench_local/mppi/critic.hpp"
#include "mrpbench_local/mppi/plan.hpp"
#include "mrpbench_local/mppi/rollout.hpp"

using namespace mrpbench::local;
using namespace mrpbench::local::mppi;
using mrpbench::OptionValues;

namespace {

constexpr std::size_t kSteps = 30, kSamples = 11;

bool near(double a, double b, double slack = 1e-4) {
  return std::abs(a - b) <= slack;
}

Batch batch(float length) {
  Batch it;
  it.dt = 0.1f;
  it.resize(kSteps, kSamples);
  it.path.length = length;
  return it;
}

void fill(Table& table, float value) {
  for (std::size_t t = 0; t < table.steps; ++t) std::fill_n(table[t], table.samples, value);
}

void add_point(LocalPath& path, float x, float y = 0, float yaw = 0, bool free = true) {
  path.x.push_back(x);
  path.y.push_back(y);
  path.yaw.push_back(yaw);
  path.free.push_back(free ? 1 : 0);
}

std::vector<float> totals(const std::string& critic, const Batch& batch, const OptionValues& options = {}) {
  const WeightedCritic it = critic_kind(critic).make(options);
  std::vector<float> raw(kSamples, 0.0f), total(kSamples, 0.0f);
  it.critic->begin(batch);
  it.critic->score(batch, raw);
  it.critic->finish(raw);
  it.add(raw, total);
  return total;
}

/// The total of every sample is this one.
bool is(double expected, const std::string& critic, const Batch& batch, const OptionValues& options = {},
        double slack = 1e-4) {
  for (const float total : totals(critic, batch, options)) {
    if (!near(total, expected, slack)) return false;
  }
  return true;
}

}  // namespace

TEST("ConstraintCritic scores speeds beyond the limits, and turns that are too tight") {
  Batch it = batch(10);
  fill(it.vx, 0.4f);
  CHECK(is(0, "ConstraintCritic", it));
  fill(it.vx, 0.6f);
  CHECK(is(1.2, "ConstraintCritic", it));
  CHECK(is(1.44, "ConstraintCritic", it, {{"cost_power", std::int64_t{2}}}));
  fill(it.vx, -0.45f);
  CHECK(is(1.2, "ConstraintCritic", it));
  it.limits.min_turning_r = 0.2f;
  fill(it.vx, 0.4f);
  fill(it.wz, 2.5f);
  CHECK(is(0.48, "ConstraintCritic", it));
  fill(it.wz, 1.5f);
  CHECK(is(0, "ConstraintCritic", it));
}

TEST("GoalAngleCritic scores the yaw near the end") {
  Batch it = batch(0.3f);
  CHECK(is(0, "GoalAngleCritic", it));  // any yaw will do
  it.goal_yaw = 3.14f;
  CHECK(is(9.42, "GoalAngleCritic", it));
  CHECK(is(0, "GoalAngleCritic", it, {{"symmetric_yaw_tolerance", true}}, 0.02));
  it.goal_yaw = 1.57f;
  CHECK(is(4.71, "GoalAngleCritic", it));
  CHECK(is(4.71, "GoalAngleCritic", it, {{"symmetric_yaw_tolerance", true}}, 0.02));
  it.path.length = 0.8f;
  CHECK(is(0, "GoalAngleCritic", it));
}

TEST("GoalCritic scores the distance from the end near it") {
  Batch it = batch(1);
  add_point(it.path, 0);
  add_point(it.path, 0.5f);
  CHECK(is(2.5, "GoalCritic", it));
  it.path.length = 1.5f;
  CHECK(is(0, "GoalCritic", it));
}

TEST("PathAngleCritic scores the angle to a point ahead, in three modes") {
  Batch it = batch(10);
  for (int i = 0; i < 10; ++i) add_point(it.path, 0);
  it.path.x[6] = -1;
  it.path.y[6] = 4;
  it.furthest = 2;
  CHECK(is(3.9947, "PathAngleCritic", it));
  CHECK(is(2.9167, "PathAngleCritic", it, {{"mode", std::int64_t{1}}}));
  CHECK(is(2.9167, "PathAngleCritic", it, {{"mode", std::int64_t{2}}}));
  it.path.x[6] = 4;
  it.path.y[6] = 1;
  CHECK(is(0, "PathAngleCritic", it));  // within max_angle_to_furthest
}

TEST("critics of preferences score driving back, turning and speeds that are not executed") {
  Batch it = batch(10);
  fill(it.vx, 1);
  CHECK(is(0, "PreferForwardCritic", it));
  fill(it.vx, -1);
  CHECK(is(15, "PreferForwardCritic", it));
  fill(it.wz, 10);
  CHECK(is(100, "TwirlingCritic", it));
  it.path.length = 0.05f;
  CHECK(is(0, "PreferForwardCritic", it) && is(0, "TwirlingCritic", it));
  fill(it.vx, 0.01f);
  fill(it.wz, -0.021f);
  // Nav2's number is 19.845 with a speed of 0.02 sideways, whose share is 35 * 3 * 0.06.
  CHECK(is(19.845 - 6.3, "VelocityDeadbandCritic", it, {{"deadband_vx", 0.08}, {"deadband_wz", 0.08}}));
}

TEST("PathFollowCritic scores the distance of the last pose from a point ahead") {
  Batch it = batch(10);
  for (int i = 0; i < 5; ++i) add_point(it.path, 0);
  add_point(it.path, 0.15f);
  CHECK(is(0.75, "PathFollowCritic", it));
  it.path.free.back() = 0;  // the last one is taken if there is no free one
  CHECK(is(0.75, "PathFollowCritic", it));
  add_point(it.path, 0.3f);
  it.path.free[6] = 1;
  CHECK(is(0.75 * 2, "PathFollowCritic", it));
  it.path.length = 1.3f;
  CHECK(is(0, "PathFollowCritic", it));
}

TEST("PathAlignCritic scores the distance from the point at the same length, unless the path is occupied") {
  Batch it = batch(10);
  for (int i = 0; i < 22; ++i) add_point(it.path, std::min(0.1f * static_cast<float>(i), 0.9f));
  it.path.spacing = 0.1f;
  it.furthest = 21;
  fill(it.x, 0.66f);
  CHECK(is(6.6, "PathAlignCritic", it));
  it.furthest = 19;
  CHECK(is(0, "PathAlignCritic", it));
  it.furthest = 21;
  it.path.free.assign(22, 0);
  CHECK(is(0, "PathAlignCritic", it));
}

TEST("CostCritic sums the costs under every second pose, and drops samples that collide") {
  CostmapOptions options;
  options.static_layer = true;
  options.footprint = {{0.1, 0.1}, {-0.1, 0.1}, {-0.1, -0.1}, {0.1, -0.1}};
  Costmap map(options, std::make_shared<const StaticMap>(std::vector<Segment>{{{1.0, -2}, {1.0, 2}}}, 4.0));
  map.update({});
  Batch it = batch(10);
  it.costmap = &map;
  it.by_radius = true;
  double expected = 0;
  for (std::size_t t = 0; t < kSteps; ++t) {
    std::fill_n(it.x[t], kSamples, 0.502f + 0.005f * static_cast<float>(t));
    if (t % 2 == 0) expected += map.at(map.frame().cell({0.502 + 0.005 * static_cast<double>(t), 0}));
  }
  CHECK(expected > 100);
  CHECK(is(3.81 * expected / 254 / 15, "CostCritic", it));
  it.x[4][0] = 1.0f;
  const auto some = totals("CostCritic", it);
  CHECK(near(some[0], 3.81e6 / 254 / 15, 1) && near(some[1], 3.81 * expected / 254 / 15));
  fill(it.x, 1.0f);
  std::vector<float> raw(kSamples, 0.0f);
  const WeightedCritic cost = critic_kind("CostCritic").make({});
  cost.critic->begin(it);
  CHECK(!cost.critic->score(it, raw));
}

TEST("the furthest point is the one where samples come") {
  Batch it = batch(10);
  for (int i = 0; i < 10; ++i) add_point(it.path, 0.2f * static_cast<float>(i));
  it.path.spacing = 0.2f;
  std::fill_n(it.x[kSteps - 1], kSamples, 1.0f);
  it.length.assign(kSamples, 3.0f);
  it.furthest = it.find_furthest();
  CHECK(it.furthest == 5 && it.beyond_furthest(2) == 7 && it.beyond_furthest(9) == 9);
  it.length.assign(kSamples, 0.3f);  // samples do not reach farther than their length
  it.furthest = it.find_furthest();
  CHECK(it.furthest == 2);
}

TEST("sampled controls are the plan and noise, and velocities follow them within accelerations") {
  const Change change{3 * 0.05f, 3 * 0.05f, 3.5f * 0.05f};
  const auto sampled = [&](float noise, float start_vx) {
    Noise its;
    for (auto* it : {&its.vx, &its.wz}) it->resize(3, 1);
    its.first = 1;
    its.vx[1][0] = static_cast<std::int16_t>(noise * 4096);  // of step 0
    Tables out;
    out.resize(3, 1);
    const std::vector<float> vx{0, 0, 0.2f}, wz{0.1f, 0, 0.3f};
    roll_out({its, 1, 1, vx, wz, {}, {}, start_vx, 6, change, 0.05f}, out);
    return out;
  };
  const Tables slower = sampled(0.75f, 5), faster = sampled(-0.75f, -5);
  CHECK(near(slower.vx[1][0], 4.85) && near(slower.wz[1][0], 5.825));
  CHECK(near(faster.vx[1][0], -4.85));
  CHECK(near(slower.length[0], (5 + 4.85 + 4.7) * 0.05));
}

TEST("samples of a late drive begin with the commands on their way, and follow the controls after these") {
  Noise none;
  for (auto* it : {&none.vx, &none.wz}) it->resize(8, 1);
  const std::vector<float> zero(8, 0.0f), vx{1, 2, 3, 4, 5, 6, 7, 8};
  const auto rolled = [&](std::span<const float> controls, std::vector<float> sent_vx, std::vector<float> sent_wz) {
    Tables out;
    out.resize(8, 1);
    roll_out({none, 1, 1, controls, zero, sent_vx, sent_wz, 0, 0, {1000, 1000, 1000}, 0.05f}, out);
    return out;
  };
  const Tables late = rolled(zero, {9}, {7, 4}), soon = rolled(vx, {}, {});  // as in Nav2: 0.10 s and 0.15 s
  CHECK(late.vx[0][0] == 0 && late.vx[1][0] == 9 && late.vx[2][0] == 0);
  CHECK(late.wz[0][0] == 0 && late.wz[1][0] == 7 && late.wz[2][0] == 4 && late.wz[3][0] == 0);
  CHECK(near(late.yaw[3][0], 11 * 0.05) && near(late.length[0], 9 * 0.05));
  const Tables both = rolled(vx, {9, 9}, {});
  for (std::size_t t = 3; t < 8; ++t) CHECK(both.vx[t][0] == soon.vx[t - 2][0]);
}

TEST("a plan keeps speeds and accelerations, the first step within a control period") {
  const Limits limits{5, -5, 5, 0};
  const auto first = [&](float wanted, double speed) {
    std::vector<float> vx{wanted}, wz{0};
    constrain(vx, wz, limits, {2, 1, 3}, speed, 0, 0.025, 0.05);
    return vx[0];
  };
  CHECK(near(first(5, 0), 0.05) && near(first(5, 0.5), 0.55) && near(first(-5, 0.5), 0.475));
  std::vector<float> vx{0.4f, 0.4f}, wz{2.5f, -2.5f};
  constrain(vx, wz, {0.5f, -0.35f, 1.9f, 0.25f}, {9, 9, 99}, 0.4, 0, 0.05, 0.05);
  CHECK(near(wz[0], 1.6) && near(wz[1], -1.6));
}

TEST("samples roll out as by Euler's method with the yaw before each step") {
  Noise none;
  for (auto* it : {&none.vx, &none.wz}) it->resize(50, 1);
  Tables out;
  out.resize(50, 1);
  const std::vector<float> vx(50, 0.1f), wz(50, 0.2f);
  roll_out({none, 1, 1, vx, wz, {}, {}, 0, 0, {1, 1, 1}, 0.1f}, out);
  CHECK(near(out.x[49][0], 0.41745, 1e-5) && near(out.y[49][0], 0.21733, 1e-5) && near(out.yaw[49][0], 0.98));
}

TEST("headings are those of sines and cosines, whether samples turn slowly or fast") {
  constexpr float dt = 0.05f;
  Noise none;
  for (auto* it : {&none.vx, &none.wz}) it->resize(56, 1);
  for (const float rate : {0.3f, 3.9f, 4.1f, 60.0f}) {
    Tables out;
    out.resize(56, 1);
    const std::vector<float> vx(56, 0.5f), wz(56, rate);
    roll_out({none, 0, 0, vx, wz, {}, {}, 0.5f, rate, {1, 1, 1}, dt}, out);
    double x = 0, y = 0, yaw = 0;
    for (std::size_t t = 0; t < 56; ++t) {
      x += 0.5 * dt * std::cos(yaw);
      y += 0.5 * dt * std::sin(yaw);
      yaw += rate * dt;
      CHECK(near(out.x[t][0], x, 2e-6) && near(out.y[t][0], y, 2e-6) && near(out.yaw[t][0], yaw, 1e-4));
    }
    CHECK(out.end_yaw[0] == out.yaw[55][0]);
  }
}

TEST("noise is normal, and that of one key does not depend on the other") {
  const auto drawn = [](std::uint64_t key) {
    Noise it;
    for (auto* rows : {&it.vx, &it.wz}) rows->resize(200, 250);
    mrpbench::sim::Draws draws(key, 0, 0);
    it.draw(draws);
    return it;
  };
  const Noise one = drawn(1), same = drawn(1), other = drawn(2);
  double mean = 0, variance = 0, both = 0, within = 0, beyond = 0, equal = 0;
  constexpr double count = 200 * 250;
  for (std::size_t t = 0; t < 200; ++t) {
    for (std::size_t k = 0; k < 250; ++k) {
      const double vx = one.vx[t][k] * Noise::kUnit, wz = one.wz[t][k] * Noise::kUnit;
      mean += vx / count;
      variance += vx * vx / count;
      both += vx * wz / count;
      within += (std::abs(vx) < 1) / count;
      beyond += (std::abs(vx) > 3) / count;
      equal += (one.vx[t][k] == other.vx[t][k]) / count;
      CHECK(one.vx[t][k] == same.vx[t][k] && one.wz[t][k] == same.wz[t][k]);
    }
  }
  CHECK(near(mean, 0, 0.02) && near(variance, 1, 0.03) && near(both, 0, 0.02) && equal < 0.01);
  CHECK(near(within, 0.6827, 0.01) && near(beyond, 0.0027, 0.001));
}

TEST("plans move by weighted deviations, of noise and of velocities alike") {
  constexpr std::size_t count = 40;
  constexpr double whole = 0.01 * count * (count + 1) / 2;
  std::vector<float> weights(2 * kBlock, 0.0f);
  Noise noise;
  noise.vx.resize(2, count);
  Table velocities;
  velocities.resize(2, count);
  double expected[2]{}, most[2]{};  // most: by which the rounded weights of noise may be off
  for (std::size_t k = 0; k < count; ++k) weights[k] = 0.01f * static_cast<float>(k + 1);
  for (std::size_t t = 0; t < 2; ++t) {
    for (std::size_t k = 0; k < count; ++k) {
      noise.vx[t][k] = static_cast<std::int16_t>(37 * k * (t + 1)) - 900;
      velocities[t][k] = 0.25f * noise.vx[t][k] + 0.5f;
      expected[t] += static_cast<double>(weights[k]) * 0.25 * noise.vx[t][k];
      most[t] += whole / 32767 / 2 * 0.25 * std::abs(noise.vx[t][k]);
    }
  }
  CHECK(near(sum(weights), whole));
  const std::vector<NoiseRow> drawn{{noise.vx[0], 0.25f}, {noise.vx[1], 0.25f}};
  const std::vector<VelocityRow> followed{{velocities[0], 0.5f}, {velocities[1], 0.5f}};
  std::vector<float> one(2, 1.0f), other(2, 1.0f), cost(count, 0.0f), same(count, 0.0f);
  const std::span<const float> its(weights.data(), velocities.width());
  add_weighted(its, NoiseRows(drawn), one);
  add_weighted(its, VelocityRows(followed), other);
  const std::vector<float> per{2, -1};
  add_deviations(NoiseRows(drawn), per, cost);
  add_deviations(VelocityRows(followed), per, same);
  for (std::size_t t = 0; t < 2; ++t) {
    CHECK(near(one[t], 1 + expected[t], most[t]) && near(other[t], 1 + expected[t], 0.05));
  }
  const std::vector<float> before = one;
  add_weighted(std::vector<float>(kBlock, 0.0f), NoiseRows(drawn), one);
  CHECK(one == before);
  for (std::size_t k = 0; k < count; ++k) {
    CHECK(near(cost[k], 0.25 * (2 * noise.vx[0][k] - noise.vx[1][k]), 1e-3) && near(same[k], cost[k], 1e-3));
  }
}

TEST("smoothing keeps constants, and spreads an impulse by the coefficients of Savitzky and Golay") {
  std::vector<float> values(30, 0.7f);
  smooth(values, {0.7f, 0.7f, 0.7f, 0.7f}, 2);
  for (const float it : values) CHECK(near(it, 0.7, 1e-6));
  std::vector<float> impulse(30, 0.0f);
  impulse[12] = 1;
  smooth(impulse, {}, 2);
  CHECK(near(impulse[12], 0.255411, 1e-6) && near(impulse[11], 54.0 / 231, 1e-6) && near(impulse[7], 0, 1e-6));
  std::vector<float> few(20, 0.0f);
  few[5] = 1;
  smooth(few, {}, 2);
  CHECK(few[5] == 1);
}
