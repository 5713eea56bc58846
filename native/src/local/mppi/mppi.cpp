// Model predictive path integral control (G. Williams, P. Drews, B. Goldfain, J. M. Rehg and E. A. Theodorou,
// "Aggressive driving with model predictive path integral control", ICRA 2016; "Information-theoretic model predictive
// control", IEEE Transactions on Robotics 34, 2018), with the parameters of Nav2.
#include "mrpbench_local/mppi/mppi.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mrpbench_local/costmap/collision.hpp"
#include "mrpbench_local/wide.hpp"
#include "mrpbench_sim/noise.hpp"

namespace mrpbench::local {

using namespace mppi;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Speeds at which the default of Nav2 reaches this many points of a path, 0.05 m apart.
constexpr double kPointsWithinReach = 28;

float clamped(double value, double low, double high) {
  return static_cast<float>(std::clamp(value, low, high));
}

/// Twists f8[m,p,2] and poses f8[m,p,3] of every so many samples and steps.
Samples trajectories(const Batch& batch, std::size_t every, std::size_t step) {
  Samples found;
  std::size_t rows = 0, columns = 0;
  for (std::size_t k = 0; k < batch.samples(); k += every, ++rows) {
    columns = 0;
    for (std::size_t t = 0; t < batch.steps(); t += step, ++columns) {
      const Pose pose = batch.in_map(batch.x[t][k], batch.y[t][k], batch.yaw[t][k]);
      found.twist.values.insert(found.twist.values.end(), {batch.vx[t][k], batch.wz[t][k]});
      found.pose.values.insert(found.pose.values.end(), {pose.x, pose.y, pose.yaw});
    }
  }
  found.twist.shape = {rows, columns, 2};
  found.pose.shape = {rows, columns, 3};
  return found;
}

}  // namespace

Description<MppiOptions> MppiOptions::nav2() {
  using M = MppiOptions;
  return {{"batch_size", &M::batch_size, within(1, 100000), "number of samples"},
          {"time_steps", &M::time_steps, within(2, 1000), "steps of a sample"},
          {"model_dt", &M::model_dt, above(0, "s"), "duration of a step; not shorter than the control period"},
          {"iteration_count", &M::iteration_count, within(1, 100), "updates per period"},
          {"temperature", &M::temperature, above(0), "how much worse samples count less; small = the best alone"},
          {"gamma", &M::gamma, at_least(0), "how much controls far from the last ones cost"},
          {"vx_std", &M::vx_std, above(0, "m/s"), "standard deviation of sampled speeds"},
          {"wz_std", &M::wz_std, above(0, "rad/s"), "standard deviation of sampled turn rates"},
          {"vx_max", &M::vx_max, above(0, "m/s"), "highest speed, within the robot's limit"},
          {"vx_min", &M::vx_min, any("m/s"), "lowest speed, within the robot's limit; negative = may drive back"},
          {"wz_max", &M::wz_max, above(0, "rad/s"), "highest turn rate, within the robot's limit"},
          {"ax_max", &M::ax_max, above(0), "acceleration, within the robot's limit, m/s^2"},
          {"ax_min", &M::ax_min, any(""), "deceleration, negative, m/s^2"},
          {"az_max", &M::az_max, above(0), "acceleration of turns, within the robot's limit, rad/s^2"},
          {"prune_distance", &M::prune_distance, above(0, "m"), "ignore the path that is farther along"},
          {"retry_attempt_limit", &M::retry_attempt_limit, within(0, 100), "new attempts when all samples collide"},
          {"open_loop", &M::open_loop, "start from the last command instead of the measured velocity"},
          {"regenerate_noises", &M::regenerate_noises, "draw new noise in every period"},
          {"clamp_raw_controls", &M::clamp_raw_controls, "limit sampled controls by the accelerations, too"},
          {"min_turning_r", &M::min_turning_r, at_least(0, "m"),
           "smallest radius of turns, of Ackermann steering; 0 = the robot turns on the spot"},
          {"sgf_order", &M::sgf_order, within(1, 2), "order of the filter that smooths the controls"},
          {"collision_lookahead_time", &M::collision_lookahead_time, above(0, "s"),
           "check the command for collisions up to this time"}};
}

Description<MppiOptions> MppiOptions::further() {
  using M = MppiOptions;
  return {
      {"path_spacing", &M::path_spacing, at_least(0, "m"),
       "distance of the points of the path that critics count; 0 = so that as many are within reach as at Nav2's "
       "highest speed and spacing"},
      {"roll_noises", &M::roll_noises,
       "begin one step later in the noise in every period, so that a robot does not stand where the plan and always "
       "the same noise balance; false = as Nav2 without regenerate_noises"},
      {"rotate_to_path", &M::rotate_to_path, at_least(0),
       "turn on the spot first where a new path leads off the heading by more than this, radians, as the rotation "
       "shim of Nav2 does; 0 = never, as MPPI alone; Ackermann steering never does"}};
}

Description<MppiOptions> MppiOptions::derived() {
  return {{"period", &MppiOptions::period, above(0, "s"), "control period"}};
}

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
  for (Table* it : {&noise_vx_, &noise_wz_}) it->resize(steps, samples);
  batch_.dt = static_cast<float>(options.model_dt);
  batch_.by_radius = robot.by_radius;
  plan_vx_.assign(steps, 0);
  plan_wz_.assign(steps, 0);
  total_.assign(samples, 0);
  raw_.assign(samples * critics_.size(), 0);
}

/// Sample noise, keyed by the seed of the run, the robot and the number of the draw.
void Mppi::draw() {
  sim::Draws draws(key_.seed, key_.robot, drawn_++);
  const auto vx = static_cast<float>(options_.vx_std), wz = static_cast<float>(options_.wz_std);
  for (std::size_t i = 0; i < noise_vx_.values.size(); ++i) {
    const auto [a, b] = draws.normal();
    noise_vx_.values[i] = static_cast<float>(a) * vx;
    noise_wz_.values[i] = static_cast<float>(b) * wz;
  }
}

void Mppi::reset() {
  std::fill(plan_vx_.begin(), plan_vx_.end(), 0.0f);
  std::fill(plan_wz_.begin(), plan_wz_.end(), 0.0f);
  past_vx_ = past_wz_ = {};
  drawn_fresh_ = false;
}

std::optional<Twist> Mppi::command(const Situation& now, const Extra& extra) {
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
  const Lent lent(batch_, plan_vx_.size(), total_.size());
  if (options_.roll_noises) rolled_ = (rolled_ + 1) % plan_vx_.size();
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
  batch_.robot = now.pose;
  batch_.tolerance = static_cast<float>(now.path.tolerance);
  batch_.goal_yaw.reset();
  if (!std::isnan(now.path.yaw)) batch_.goal_yaw = static_cast<float>(wrapped(now.path.yaw - now.pose.yaw));
  const double reach = it.time_steps * it.model_dt * it.vx_max;
  const double spacing = it.path_spacing > 0 ? it.path_spacing : std::min(0.05, reach / kPointsWithinReach);
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

/// Draw the samples around the plan that is their centre.
MRPBENCH_WIDE void Mppi::sample(Batch& batch) const {
  const std::size_t steps = batch.steps(), samples = batch.samples();
  const MppiOptions& it = options_;
  for (std::size_t t = 0; t < steps; ++t) {
    const float vx = centre_vx_[t], wz = centre_wz_[t];
    const std::size_t drawn = (t + rolled_) % steps;
    const float *nv = noise_vx_[drawn], *nw = noise_wz_[drawn];
    float *cv = batch.control_vx[t], *cw = batch.control_wz[t];
    for (std::size_t k = 0; k < samples; ++k) cv[k] = vx + nv[k];
    for (std::size_t k = 0; k < samples; ++k) cw[k] = wz + nw[k];
  }
  const float dt = batch.dt;
  const Change change{static_cast<float>(it.ax_max) * dt, static_cast<float>(-it.ax_min) * dt,
                      static_cast<float>(it.az_max) * dt};
  limit(batch.control_vx, batch.control_wz, static_cast<float>(start_.ahead), static_cast<float>(start_.turn), change,
        batch.vx, batch.wz);
  if (it.clamp_raw_controls) {
    const auto second = static_cast<std::ptrdiff_t>(samples);
    std::copy(batch.vx.values.begin() + second, batch.vx.values.end(), batch.control_vx.values.begin());
    std::copy(batch.wz.values.begin() + second, batch.wz.values.end(), batch.control_wz.values.begin());
  }
  roll_out(batch.vx, batch.wz, dt, batch.x, batch.y, batch.yaw);
}

/// One update of the plan. Returns false if every sample collides.
MRPBENCH_WIDE bool Mppi::improve(const Extra& extra) {
  const std::size_t steps = batch_.steps(), samples = batch_.samples();
  const MppiOptions& it = options_;
  begin_plan();
  centre_vx_ = plan_vx_;
  centre_wz_ = plan_wz_;
  sample(batch_);
  batch_.find_furthest();
  if (!score(extra)) return false;
  for (std::size_t t = 0; t < steps; ++t) {
    const float on_vx = plan_vx_[t] * static_cast<float>(it.gamma / (it.vx_std * it.vx_std));
    const float on_wz = plan_wz_[t] * static_cast<float>(it.gamma / (it.wz_std * it.wz_std));
    const float *cv = batch_.control_vx[t], *cw = batch_.control_wz[t];
    const float vx = plan_vx_[t], wz = plan_wz_[t];
    for (std::size_t k = 0; k < samples; ++k) total_[k] += on_vx * (cv[k] - vx) + on_wz * (cw[k] - wz);
  }
  const float least = *std::min_element(total_.begin(), total_.end());
  if (!(least < kInfinity)) return false;
  const auto sharpness = static_cast<float>(-1 / it.temperature);
  weight_.resize(samples);
  for (std::size_t k = 0; k < samples; ++k) weight_[k] = std::exp((total_[k] - least) * sharpness);
  const float per = 1 / sum(weight_.data(), samples);
  for (std::size_t t = 0; t < steps; ++t) {
    plan_vx_[t] = weighted_sum(weight_.data(), batch_.control_vx[t], samples) * per;
    plan_wz_[t] = weighted_sum(weight_.data(), batch_.control_wz[t], samples) * per;
  }
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

/// The totals of the critics. Returns false if every sample collides.
bool Mppi::score(const Extra& extra) {
  const std::size_t samples = batch_.samples();
  std::fill(total_.begin(), total_.end(), 0.0f);
  std::fill(raw_.begin(), raw_.end(), 0.0f);
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    const WeightedCritic& it = critics_[c];
    if (it.weight == 0) continue;
    const std::span<float> raw(&raw_[c * samples], samples);
    if (!it.critic->score(batch_, raw)) {
      std::fill(total_.begin(), total_.end(), kInfinity);
      return false;
    }
    it.add(raw, total_);
  }
  if (!extra) return true;
  std::vector<double> added(samples, 0.0);
  extra(trajectories(batch_, 1, 1), added);
  added_.assign(added.begin(), added.end());
  for (std::size_t k = 0; k < samples; ++k) total_[k] += added_[k];
  return true;
}

/// Call `visit(pose)` at the end of each of the first steps of the plan, until it returns false.
template <class Visit>
bool Mppi::walk(std::size_t steps, Visit&& visit) const {
  Pose pose = batch_.robot;
  for (std::size_t t = 0; t < steps; ++t) {
    pose.x += plan_vx_[t] * std::cos(pose.yaw) * options_.model_dt;
    pose.y += plan_vx_[t] * std::sin(pose.yaw) * options_.model_dt;
    pose.yaw += plan_wz_[t] * options_.model_dt;
    if (!visit(pose)) return false;
  }
  return true;
}

/// Tell whether the plan is free of collisions for a while.
bool Mppi::is_safe() const {
  const auto steps =
      std::min(plan_vx_.size(), static_cast<std::size_t>(options_.collision_lookahead_time / options_.model_dt));
  return walk(steps, [&](Pose pose) { return is_free(*batch_.costmap, pose, batch_.by_radius); });
}

/// What each critic, and then those of the caller if there are some, contributes to the mean total of the plan.
std::vector<double> Mppi::mean_scores() const {
  const std::size_t samples = total_.size();
  const float per = 1 / sum(weight_.data(), samples);
  std::vector<double> found;
  std::vector<float> scores(samples);
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    std::fill(scores.begin(), scores.end(), 0.0f);
    if (critics_[c].weight != 0) critics_[c].add(std::span<const float>(raw_).subspan(c * samples, samples), scores);
    found.push_back(weighted_sum(weight_.data(), scores.data(), samples) * per);
  }
  if (!added_.empty()) found.push_back(weighted_sum(weight_.data(), added_.data(), samples) * per);
  return found;
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

Explanation Mppi::explain() const {
  Explanation found;
  found.words["reason"] = {fault_};
  if (!scored_) return found;
  constexpr std::size_t every = 5;
  Batch batch = batch_;
  const Lent lent(batch, plan_vx_.size(), total_.size());
  sample(batch);
  Samples samples = trajectories(batch, every, 3);
  found.arrays = {{"twist", std::move(samples.twist)},
                  {"pose", std::move(samples.pose)},
                  {"score", {{raw_.begin(), raw_.end()}, {critics_.size(), total_.size()}}},
                  {"total", {{total_.begin(), total_.end()}, {total_.size()}}}};
  Array& plan = found.arrays["plan"];
  for (std::size_t t = 0; t < plan_vx_.size(); ++t) plan.values.insert(plan.values.end(), {plan_vx_[t], plan_wz_[t]});
  plan.shape = {plan_vx_.size(), 2};
  for (const WeightedCritic& it : critics_) found.words["critics"].push_back(it.name);
  Array& cost = found.arrays["cost"];
  for (std::size_t k = 0; k < total_.size(); k += every) cost.values.push_back(total_[k]);
  cost.shape = {cost.values.size()};
  if (*fault_) return found;
  Array& chosen = found.arrays["chosen"];
  const auto add = [&](Pose pose) {
    chosen.values.insert(chosen.values.end(), {pose.x, pose.y, pose.yaw});
    return true;
  };
  add(batch_.robot);
  walk(plan_vx_.size(), add);
  chosen.shape = {chosen.values.size() / 3, 3};
  Array& scores = found.arrays["chosen_score"];
  scores.values = mean_scores();
  scores.shape = {scores.values.size()};
  return found;
}

ControllerKind mppi_controller() {
  Description<MppiOptions> rows = MppiOptions::nav2();
  for (const auto& group : {MppiOptions::further(), MppiOptions::derived()}) {
    rows.insert(rows.end(), group.begin(), group.end());
  }
  ControllerKind kind;
  kind.make = [rows](const OptionValues& values, const RobotOptions& robot, RandomKey key,
                     std::span<const CriticChoice> chosen) {
    std::vector<WeightedCritic> critics;
    for (const CriticChoice& it : chosen) {
      try {
        critics.push_back(mppi::critic_kind(it.name).make(it.options));
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(it.name + ": " + error.what());
      }
      critics.back().name = it.name;
    }
    return std::make_unique<Mppi>(configured(rows, values, MppiOptions{}), robot, key, std::move(critics));
  };
  kind.nav2 = parameters(MppiOptions::nav2());
  kind.further = parameters(MppiOptions::further());
  kind.derived = parameters(MppiOptions::derived());
  kind.critic_options = [](const std::string& name) { return mppi::critic_kind(name).options; };
  return kind;
}

}  // namespace mrpbench::local
