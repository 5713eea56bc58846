// Model predictive path integral control (G. Williams, P. Drews, B. Goldfain, J. M. Rehg and E. A. Theodorou,
// "Aggressive driving with model predictive path integral control", ICRA 2016; "Information-theoretic model predictive
// control", IEEE Transactions on Robotics 34, 2018), with the parameters of Nav2.
#include "mrpbench_local/mppi/mppi.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mrpbench_local/costmap/collision.hpp"
#include "mrpbench_sim/noise.hpp"

namespace mrpbench::local {

using namespace mppi;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Lower powers of e are less than half of the least number.
constexpr float kLeastExponent = -104;
/// Speeds at which the default of Nav2 reaches this many points of a path, 0.05 m apart.
constexpr double kPointsWithinReach = 28;
constexpr double kLeastSpacing = 0.001;  // metres between points of the path

float clamped(double value, double low, double high) {
  return static_cast<float>(std::clamp(value, low, high));
}

}  // namespace

Mppi::Mppi(const MppiOptions& options, const RobotOptions& robot, RandomKey key, std::vector<WeightedCritic> critics)
    : options_(options),
      key_(key),
      critics_(std::move(critics)),
      rotate_(options.min_turning_r > 0 ? 0 : options.rotate_to_path, {options.wz_max, options.az_max}) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(options.period <= options.model_dt + 1e-9, "the control period must not exceed model_dt");
  require(options.ax_min < 0, "ax_min must be negative");
  require(options.vx_min <= options.vx_max, "vx_min exceeds vx_max");
  shift_ = std::abs(options.period - options.model_dt) < 1e-9;
  const auto steps = static_cast<std::size_t>(options.time_steps),
             samples = static_cast<std::size_t>(options.batch_size);
  for (std::size_t first = 0; first < samples; first += kBlock) {
    Noise& its = noise_.emplace_back();
    for (auto* it : {&its.vx, &its.wz}) it->resize(steps, std::min(kBlock, samples - first));
  }
  batch_.dt = static_cast<float>(options.model_dt);
  batch_.by_radius = robot.by_radius;
  plan_vx_.assign(steps, 0);
  plan_wz_.assign(steps, 0);
  for (const auto& [delay, sent] :
       {std::pair{options.model_delay_vx, &sent_vx_}, {options.model_delay_wz, &sent_wz_}}) {
    const double late = std::round(delay / options.model_dt);
    require(late < static_cast<double>(steps), "a delay must be shorter than the samples, time_steps * model_dt");
    sent->assign(static_cast<std::size_t>(std::max(late, 1.0)) - 1, 0);  // the first step is one late already
  }
  given_.assign(periods(std::max(sent_vx_.size(), sent_wz_.size())), {});
  total_.assign(samples, 0);
  raw_.assign(samples * critics_.size(), 0);
}

/// Sample noise, keyed by the seed of the run, the robot and the number of the draw.
void Mppi::draw() {
  sim::Draws draws(key_.seed, key_.robot, drawn_++);
  for (Noise& its : noise_) its.draw(draws);
}

void Mppi::reset() {
  std::fill(plan_vx_.begin(), plan_vx_.end(), 0.0f);
  std::fill(plan_wz_.begin(), plan_wz_.end(), 0.0f);
  past_vx_ = past_wz_ = {};
  drawn_fresh_ = false;
}

std::optional<Twist> Mppi::command(const Situation& now, const Extra& extra) {
  recall(&Twist::ahead, sent_vx_);
  recall(&Twist::turn, sent_wz_);
  const std::optional<Twist> found = decide(now, extra);
  if (!given_.empty()) {
    std::rotate(given_.begin(), given_.begin() + 1, given_.end());
    given_.back() = found.value_or(Twist{});
  }
  return found;
}

/// The control periods in which so many steps pass.
std::size_t Mppi::periods(std::size_t steps) const {
  return static_cast<std::size_t>(std::round(static_cast<double>(steps) * options_.model_dt / options_.period));
}

/// Fill the commands of one axis on their way: the one that takes effect last was given one step ago.
void Mppi::recall(double Twist::* axis, std::vector<float>& sent) const {
  for (std::size_t j = 0; j < sent.size(); ++j) {
    sent[j] = static_cast<float>(given_[given_.size() - periods(sent.size() - j)].*axis);
  }
}

std::optional<Twist> Mppi::decide(const Situation& now, const Extra& extra) {
  fault_ = "";
  scored_ = false;
  const Point end = now.path.end();
  if (is_new(goal_, now.path)) {
    goal_ = {end.x, end.y, now.path.yaw};
    rotate_.begin(now.pose, now.path);
  }
  if (const auto turn = rotate_.command(now.pose, now.path, *now.costmap)) {
    reset();
    return last_ = *turn;
  }
  prepare(now);
  const double away = sim::length(end - Point{now.pose.x, now.pose.y});
  if (away <= now.path.tolerance / 2 && std::isnan(now.path.yaw)) {
    reset();
    last_ = {};
    return last_;
  }
  scored_ = true;
  if (options_.roll_noises) {
    for (Noise& its : noise_) its.first = (its.first + 1) % plan_vx_.size();
  }
  for (int attempt = 0; attempt <= options_.retry_attempt_limit; ++attempt) {
    if (!drawn_fresh_ || options_.regenerate_noises) draw();
    drawn_fresh_ = true;
    bool sound = true;
    for (int i = 0; sound && i < options_.iteration_count; ++i) sound = improve(extra);
    if (sound && is_safe()) return last_ = send();
    reset();
  }
  fault_ = "all samples collide";
  last_ = {};
  return std::nullopt;
}

/// Take over state, limits and path.
void Mppi::prepare(const Situation& now) {
  const MppiOptions& it = options_;
  const double period = it.period;
  const Twist measured = now.twist;
  start_.ahead = it.open_loop
                     ? last_.ahead
                     : clamped(last_.ahead, measured.ahead + period * it.ax_min, measured.ahead + period * it.ax_max);
  start_.turn = it.open_loop
                    ? last_.turn
                    : clamped(last_.turn, measured.turn - period * it.az_max, measured.turn + period * it.az_max);
  const double share = std::min(1.0, now.path.speed / it.vx_max);
  batch_.limits = {static_cast<float>(it.vx_max * share), static_cast<float>(it.vx_min * share),
                   static_cast<float>(it.wz_max * share), static_cast<float>(it.min_turning_r)};
  batch_.costmap = now.costmap;
  batch_.forecast = now.forecast;
  batch_.place(now.pose);
  batch_.tolerance = static_cast<float>(now.path.tolerance);
  batch_.goal_yaw.reset();
  if (!std::isnan(now.path.yaw)) batch_.goal_yaw = static_cast<float>(wrapped(now.path.yaw - now.pose.yaw));
  const double reach = it.time_steps * it.model_dt * it.vx_max;
  const double wanted = it.path_spacing > 0 ? it.path_spacing : std::min(0.05, reach / kPointsWithinReach);
  const double spacing = std::max(wanted, kLeastSpacing);
  const double side = now.costmap->options().width / 2;
  const std::vector<Point> points =
      resampled(from_nearest(in_frame_of(now.pose, now.path), side), spacing, std::min(it.prune_distance, side));
  LocalPath& path = batch_.path;
  const std::size_t count = points.size();
  path.x.resize(count);
  path.y.resize(count);
  path.yaw.resize(count);
  path.free.resize(count);
  path.spacing = static_cast<float>(spacing);
  path.length = static_cast<float>(length_of(points));
  for (std::size_t i = 0; i < count; ++i) {
    path.x[i] = static_cast<float>(points[i].x);
    path.y[i] = static_cast<float>(points[i].y);
    const Point leg = i + 1 < count ? points[i + 1] - points[i] : points[i] - points[i - 1];
    path.yaw[i] = static_cast<float>(std::atan2(leg.y, leg.x));
    const Pose pose = batch_.in_map(path.x[i], path.y[i], 0);
    const Cell c = now.costmap->frame().cell({pose.x, pose.y});
    path.free[i] = now.costmap->frame().holds(c) && now.costmap->at(c) < kInscribed ? 1 : 0;
  }
}

/// Sample around the plan that is the centre.
void Mppi::sample(Batch& batch) const {
  const float dt = batch.dt;
  const Change change{static_cast<float>(options_.ax_max) * dt, static_cast<float>(-options_.ax_min) * dt,
                      static_cast<float>(options_.az_max) * dt};
  roll_out({noise_[batch.first / kBlock], static_cast<float>(options_.vx_std), static_cast<float>(options_.wz_std),
            centre_vx_, centre_wz_, sent_vx_, sent_wz_, static_cast<float>(start_.ahead),
            static_cast<float>(start_.turn), change, dt},
           batch);
}

/// Call `visit(steps, std, centre, plan)` with how far the controls of a block are from the centre, on each
/// axis: noise, or what is left of it in the velocities that follow, if controls are to be within the accelerations,
/// too.
template <class Visit>
void Mppi::each_deviation(Visit&& visit) {
  const Noise& its = noise_[batch_.first / kBlock];
  const auto axis = [&](const Rows<std::int16_t>& noise, double std, const Table& velocities, std::size_t late,
                        std::span<const float> centre, std::span<float> plan) {
    const std::size_t clamped = options_.clamp_raw_controls ? plan.size() - 1 - late : 0;
    std::vector<VelocityRow> followed;
    for (std::size_t t = 0; t < clamped; ++t) followed.push_back({velocities[t + 1 + late], centre[t]});
    if (clamped > 0) visit(VelocityRows(followed), std, centre, plan);
    std::vector<NoiseRow> drawn;
    drawn.reserve(plan.size());
    for (std::size_t t = clamped; t < plan.size(); ++t) {
      drawn.push_back({noise[its.row(t)], static_cast<float>(std) * Noise::kUnit});
    }
    visit(NoiseRows(drawn), std, centre.subspan(clamped), plan.subspan(clamped));
  };
  axis(its.vx, options_.vx_std, batch_.vx, sent_vx_.size(), centre_vx_, plan_vx_);
  axis(its.wz, options_.wz_std, batch_.wz, sent_wz_.size(), centre_wz_, plan_wz_);
}

/// One update of the plan. Returns false if every sample collides.
bool Mppi::improve(const Extra& extra) {
  const std::size_t samples = total_.size();
  const MppiOptions& it = options_;
  begin_plan();
  centre_vx_ = plan_vx_;
  centre_wz_ = plan_wz_;
  std::fill(total_.begin(), total_.end(), 0.0f);
  std::fill(raw_.begin(), raw_.end(), 0.0f);
  free_.assign(critics_.size(), 0);
  for (const WeightedCritic& critic : critics_) critic.critic->begin(batch_);
  std::size_t furthest = 0;
  each_block(batch_, [&] {
    sample(batch_);
    const std::span<float> total(&total_[batch_.first], batch_.samples());
    each_deviation([&](auto steps, double std, std::span<const float> centre, std::span<float>) {
      std::vector<float> per(centre.begin(), centre.end());
      for (float& cost : per) cost *= static_cast<float>(it.gamma / (std * std));
      add_deviations(steps, per, total);
    });
    furthest = std::max(furthest, batch_.find_furthest());
    score(false);
  });
  batch_.furthest = furthest;
  each_block(batch_, [&] { score(true); });
  if (!add_scores(extra)) return false;
  const float least = *std::min_element(total_.begin(), total_.end());
  if (!(least < kInfinity)) return false;
  const auto sharpness = static_cast<float>(-1 / it.temperature);
  weight_.assign((samples + kBlock - 1) / kBlock * kBlock, 0);
  for (std::size_t k = 0; k < samples; ++k) {
    const float exponent = (total_[k] - least) * sharpness;
    if (exponent >= kLeastExponent) weight_[k] = std::exp(exponent);
  }
  const float per = 1 / sum(weight_);
  for (float& it : weight_) it *= per;
  each_block(batch_, [&] {
    if (it.clamp_raw_controls) sample(batch_);
    const std::span<const float> weights(&weight_[batch_.first], batch_.vx.width());
    each_deviation(
        [&](auto steps, double, std::span<const float>, std::span<float> plan) { add_weighted(weights, steps, plan); });
  });
  smooth(plan_vx_, past_vx_, it.sgf_order);
  smooth(plan_wz_, past_wz_, it.sgf_order);
  constrain(plan_vx_, plan_wz_, batch_.limits, {it.ax_max, -it.ax_min, it.az_max}, start_.ahead, start_.turn, it.period,
            it.model_dt);
  return true;
}

/// The first control begins with the velocity that the robot has, or near it if steps are longer than control periods.
void Mppi::begin_plan() {
  const double period = options_.period;
  if (shift_) {
    plan_vx_[0] = static_cast<float>(start_.ahead);
    plan_wz_[0] = static_cast<float>(start_.turn);
    return;
  }
  plan_vx_[0] = clamped(plan_vx_[0], start_.ahead + period * options_.ax_min, start_.ahead + period * options_.ax_max);
  plan_wz_[0] = clamped(plan_wz_[0], start_.turn - period * options_.az_max, start_.turn + period * options_.az_max);
}

/// Score a block by the critics that look at the furthest point of the path, or by the others.
void Mppi::score(bool by_furthest) {
  const std::size_t samples = total_.size();
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    const WeightedCritic& it = critics_[c];
    if (it.weight == 0 || it.critic->looks_at_furthest() != by_furthest) continue;
    if (it.critic->score(batch_, {&raw_[c * samples + batch_.first], batch_.samples()})) free_[c] = 1;
  }
}

/// Add what all critics score. Returns false if every sample collides.
bool Mppi::add_scores(const Extra& extra) {
  const std::size_t samples = total_.size();
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    const WeightedCritic& it = critics_[c];
    if (it.weight == 0) continue;
    const std::span<float> raw(&raw_[c * samples], samples);
    it.critic->finish(raw);
    if (!free_[c]) {
      std::fill(total_.begin(), total_.end(), kInfinity);
      return false;
    }
    it.add(raw, total_);
  }
  if (!extra) return true;
  std::vector<double> added(samples, 0.0);
  Samples all;
  each_block(batch_, [&] {
    sample(batch_);
    add_trajectories(batch_, 1, 1, all);
  });
  extra(all, added);
  added_.assign(added.begin(), added.end());
  for (std::size_t k = 0; k < samples; ++k) total_[k] += added_[k];
  return true;
}

/// Tell whether the plan is free of collisions for a while.
bool Mppi::is_safe() const {
  const auto steps =
      std::min(plan_vx_.size(), static_cast<std::size_t>(options_.collision_lookahead_time / options_.model_dt));
  return walk(steps, [&](Pose pose) { return is_free(*batch_.costmap, pose, batch_.by_radius); });
}

/// The command of the plan; the plan moves on by one step if a step is a control period.
Twist Mppi::send() {
  const std::size_t at = shift_ ? 1 : 0;
  const Twist sent{plan_vx_[at], plan_wz_[at]};
  for (auto* past : {&past_vx_, &past_wz_}) std::rotate(past->begin(), past->begin() + 1, past->end());
  past_vx_.back() = plan_vx_[at];
  past_wz_.back() = plan_wz_[at];
  if (shift_) {
    for (auto* plan : {&plan_vx_, &plan_wz_}) std::copy(plan->begin() + 1, plan->end(), plan->begin());
  }
  return sent;
}

}  // namespace mrpbench::local
