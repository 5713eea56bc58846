#include "mrpbench_local/dwb/dwb.hpp"

#include <algorithm>
#include <limits>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local {

namespace {

double thresholded(double speed, double threshold) {
  return std::abs(speed) < threshold ? 0 : speed;
}

/// Twists f8[m,2], and poses f8[m,p,3]: one trajectory after the other, each padded with its last pose.
Samples samples_of(const Trajectories& all) {
  std::vector<std::vector<Pose>> walked(all.size());
  std::size_t longest = 1;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all.walk(i, [&](Pose pose) {
      walked[i].push_back(pose);
      return true;
    });
    longest = std::max(longest, walked[i].size());
  }
  Samples found{{{}, {all.size(), 2}}, {{}, {all.size(), longest, 3}}};
  found.pose.values.reserve(all.size() * longest * 3);
  for (std::size_t i = 0; i < all.size(); ++i) {
    found.twist.values.insert(found.twist.values.end(), {all.twist(i).ahead, all.twist(i).turn});
    walked[i].resize(longest, walked[i].back());
    for (const Pose& it : walked[i]) found.pose.values.insert(found.pose.values.end(), {it.x, it.y, it.yaw});
  }
  return found;
}

MRPBENCH_WIDE void add_scaled(std::size_t count, const double* raw, double scale, double* total) {
  for (std::size_t i = 0; i < count; ++i) total[i] += raw[i] * scale;
}

}  // namespace

/// What one command needs, shared by the robots that a thread controls one after the other, so that it stays in its
/// cache.
struct Dwb::Buffers {
  Trajectories all;
  PathGrid path;
  EndCells ends;
  std::vector<Reason> fault;
  std::vector<std::size_t> order;

  static Buffers& of_thread();
};

Description<DwbOptions> DwbOptions::nav2() {
  Description<DwbOptions> rows;
  append(rows, MotionOptions::description(), &DwbOptions::motion);
  append(rows,
         Description<Pruning>{{"prune_distance", &Pruning::prune_distance, above(0, "m").usually(0.5, 2),
                               "ignore parts of the path that are farther away"},
                              {"shorten_transformed_plan", &Pruning::shorten,
                               "use prune_distance; if false, half the size of the costmap"}},
         &DwbOptions::pruning);
  rows.push_back({"short_circuit_trajectory_evaluation", &DwbOptions::short_circuit,
                  "stop scoring a trajectory that cannot win; false = score all in full, for `explain`"});
  return rows;
}

Description<DwbOptions> DwbOptions::further() {
  return {
      {{"beyond_end", &Pruning::beyond_end, at_least(0, "m"),
        "prolong the path straight beyond its end by this, for critics that measure distances to it or to its end, so "
        "that a robot comes nearer to the end than the 0.25 m of Nav2 without creeping; 0 = as in Nav2"},
       &DwbOptions::pruning},
      {"rotate_to_path", &DwbOptions::rotate_to_path, at_least(0),
       "turn on the spot first where a new path leads off the heading by more than this, radians, as the rotation "
       "shim of Nav2 does; 0 = never, as DWB alone"}};
}

Description<DwbOptions> DwbOptions::derived() {
  return {{{"period", &MotionOptions::period, above(0, "s"), "control period"}, &DwbOptions::motion}};
}

Dwb::Dwb(const DwbOptions& options, std::vector<Weighted> critics)
    : options_(options),
      critics_(std::move(critics)),
      rotate_(options.rotate_to_path, {options.motion.max_vel_theta, options.motion.acc_lim_theta}) {
  const MotionOptions& motion = options.motion;
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(motion.sim_time > 0 && motion.linear_granularity > 0 && motion.angular_granularity > 0 &&
              motion.time_granularity > 0,
          "sim_time and granularities must be positive");
  require(motion.acc_lim_x > 0 && motion.acc_lim_theta > 0 && motion.decel_lim_x < 0 && motion.decel_lim_theta < 0,
          "acceleration limits must be positive, deceleration limits negative");
  require(motion.min_vel_x <= motion.max_vel_x && motion.max_vel_theta >= 0, "the lowest speed exceeds the highest");
  require(
      motion.vx_samples > 0 && motion.vtheta_samples > 0 && motion.vx_samples <= 1000 && motion.vtheta_samples <= 1000,
      "there must be 1 to 1000 samples of each speed");
  for (const Weighted& it : critics_) looks_ahead_ = std::max(looks_ahead_, it.critic->looks_ahead());
}

std::optional<Twist> Dwb::command(const Situation& it, const Extra& extra) {
  const Path& path = it.path;
  const Pose& pose = it.pose;
  const Frame& frame = it.costmap->frame();
  const Point end = path.end();
  chosen_.reset();
  scores_.total.clear();
  if (is_new(goal_, path)) {
    goal_ = {end.x, end.y, path.yaw};
    for (const Weighted& each : critics_) each.critic->reset();
    rotate_.begin(pose, path);
  }
  if (std::isnan(path.yaw) && sim::length({pose.x - end.x, pose.y - end.y}) <= frame.resolution) return Twist{};
  if (const auto turn = rotate_.command(pose, path, *it.costmap)) return turn;
  // What is needed soon: the critics and costmaps of a fleet do not fit the cache.
  for (const Weighted& each : critics_) __builtin_prefetch(each.critic.get());
  it.costmap->fetch();
  Buffers& its = Buffers::of_thread();
  its.path.take(frame, {pose.x, pose.y}, path.first, path.rest, options_.pruning);
  const Twist measured{thresholded(it.twist.ahead, options_.min_x_velocity_threshold),
                       thresholded(it.twist.turn, options_.min_theta_velocity_threshold)};
  sampled_ = {pose, measured, std::min(path.speed, speed_to_stop(its.path.left(), frame.resolution)), it.costmap};
  its.all.generate(options_.motion, pose, measured, sampled_.fastest);
  its.ends.begin(frame, its.all);
  if (!its.path.empty()) {
    const auto [low, high] = its.ends.box(frame.cell({pose.x, pose.y}));
    const int ahead = whole_below(looks_ahead_ / frame.resolution) + 1;
    its.path.spread(frame, {low.x - ahead, low.y - ahead}, {high.x + ahead, high.y + ahead});
  }
  const Scene scene{it.now, pose, measured, *goal_, path.tolerance, it.costmap, &its.path, &its.ends, it.forecast};
  score(scene, its, extra);
  chosen_ = best(scene, its);
  const Twist command = chosen_ ? its.all.twist(*chosen_) : Twist{};
  for (const Weighted& it : critics_) it.critic->debrief(scene, command);
  if (!chosen_) return std::nullopt;
  return command;
}

/// The speed from which a robot can still brake at half a cell before the end of its path, `left` metres ahead.
double Dwb::speed_to_stop(double left, double cell) const {
  return std::sqrt(-2 * options_.motion.decel_lim_x * (std::max(left, cell) - cell / 2));
}

Dwb::Buffers& Dwb::Buffers::of_thread() {
  thread_local Buffers buffers;
  return buffers;
}

/// Totals of all trajectories, from critics that need only their last poses.
void Dwb::score(const Scene& scene, Buffers& its, const Extra& extra) {
  const std::size_t count = its.all.size();
  Scores& of = scores_;
  of.total.assign(count, 0);
  of.why.assign(count, kLegal);
  of.dropped.assign(count, -1);
  of.raw.resize(count * critics_.size());
  of.scale.assign(critics_.size(), 0);
  of.complete = false;
  its.fault.resize(count, kLegal);  // it is full of that
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    const Weighted& it = critics_[c];
    it.critic->prepare(scene);
    const std::span<double> raw(&of.raw[c * count], count);
    const double scale = of.scale[c] = it.scale * it.critic->weight(scene);
    if (scale == 0) {
      std::ranges::fill(raw, 0);
      continue;
    }
    const bool faulty = it.critic->score(scene, its.all, raw, its.fault);
    add_scaled(count, raw.data(), scale, of.total.data());
    for (std::size_t i = 0; faulty && i < count; ++i) {
      if (!its.fault[i]) continue;
      if (!of.why[i]) {
        of.why[i] = its.fault[i];
        of.dropped[i] = static_cast<int>(c);
      }
      its.fault[i] = kLegal;
    }
  }
  if (!extra) return;
  of.added.assign(count, 0);
  extra(samples_of(its.all), of.added);
  for (std::size_t i = 0; i < count; ++i) of.total[i] += of.added[i];
}

/// Let critics say of all trajectories what they left open.
void Dwb::complete(const Scene& scene, const Trajectories& all, Scores& scores) const {
  if (scores.complete) return;
  scores.complete = true;
  const std::size_t count = all.size();
  std::vector<Reason> fault(count, kLegal);
  const auto total = [&](std::size_t i) {
    double sum = 0;
    for (std::size_t c = 0; c < critics_.size(); ++c) {
      if (scores.scale[c] != 0) sum += scores.raw[c * count + i] * scores.scale[c];
    }
    return scores.added.empty() ? sum : sum + scores.added[i];
  };
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    const std::span<double> raw(&scores.raw[c * count], count);
    if (scores.scale[c] == 0 || !critics_[c].critic->complete(scene, all, raw, fault)) continue;
    for (std::size_t i = 0; i < count; ++i) {
      if (!fault[i]) continue;
      if (!scores.why[i] || scores.dropped[i] > static_cast<int>(c)) {
        scores.why[i] = fault[i];
        scores.dropped[i] = static_cast<int>(c);
      }
      scores.total[i] = total(i);
      fault[i] = kLegal;
    }
  }
}

/// Check all poses of a trajectory.
bool Dwb::passes(const Scene& scene, const Trajectories& all, std::size_t i) {
  Reason& why = scores_.why[i];
  for (std::size_t c = 0; !scores_.complete && c < critics_.size(); ++c) {
    if (scores_.scale[c] == 0) continue;
    why = critics_[c].critic->check_end(scene, all.end(i));
    if (!why) continue;
    scores_.dropped[i] = static_cast<int>(c);
    return false;
  }
  return all.walk(i, [&](Pose pose) {
    for (std::size_t c = 0; c < critics_.size(); ++c) {
      const Weighted& it = critics_[c];
      if (it.scale == 0) continue;
      why = it.critic->check(scene, pose);
      if (!why) continue;
      scores_.dropped[i] = static_cast<int>(c);
      return false;
    }
    return true;
  });
}

/// The trajectory with the lowest total, of equal ones the first. Trajectories that cannot win by their totals are not
/// checked pose by pose: DWB's short-circuit evaluation, applied to whole trajectories.
std::optional<std::size_t> Dwb::best(const Scene& scene, Buffers& its) {
  const std::vector<double>& total = scores_.total;
  const auto may_win = [&](std::size_t i) {
    return !scores_.why[i] && total[i] < std::numeric_limits<double>::infinity();
  };
  if (!options_.short_circuit) complete(scene, its.all, scores_);
  for (std::size_t i = 0; !options_.short_circuit && i < its.all.size(); ++i) {
    if (may_win(i)) passes(scene, its.all, i);
  }
  std::optional<std::size_t> first;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < its.all.size(); ++i) {
    if (!(total[i] < lowest) || scores_.why[i]) continue;
    lowest = total[i];
    first = i;
  }
  if (!first || passes(scene, its.all, *first)) return first;
  complete(scene, its.all, scores_);
  its.order.clear();
  for (std::size_t i = 0; i < its.all.size(); ++i) {
    if (may_win(i)) its.order.push_back(i);
  }
  const auto worse = [&](std::size_t a, std::size_t b) { return total[a] != total[b] ? total[a] > total[b] : a > b; };
  std::ranges::make_heap(its.order, worse);
  for (; !its.order.empty(); its.order.pop_back()) {
    if (passes(scene, its.all, its.order.front())) return its.order.front();
    std::ranges::pop_heap(its.order, worse);
  }
  return std::nullopt;
}

Explanation Dwb::explain() const {
  const std::size_t count = scores_.total.size();
  Explanation found;
  if (count == 0) return found;
  Trajectories all;
  all.generate(options_.motion, sampled_.pose, sampled_.twist, sampled_.fastest);
  EndCells ends;
  ends.begin(sampled_.costmap->frame(), all);
  Scene scene;
  scene.costmap = sampled_.costmap;
  scene.ends = &ends;
  Scores scores = scores_;
  complete(scene, all, scores);
  Samples samples = samples_of(all);
  found.arrays = {{"twist", std::move(samples.twist)},
                  {"pose", std::move(samples.pose)},
                  {"score", {scores.raw, {critics_.size(), count}}},
                  {"total", {scores.total, {count}}}};
  for (const Weighted& it : critics_) found.words["critics"].push_back(it.name);
  std::vector<std::string>& reasons = found.words["reason"];
  for (std::size_t i = 0; i < count; ++i) {
    const int critic = scores.dropped[i];
    reasons.push_back(critic < 0 ? "" : critics_[static_cast<std::size_t>(critic)].name + ": " + scores.why[i]);
  }
  Array& cost = found.arrays["cost"] = {scores.total, {count}};
  for (std::size_t i = 0; i < count; ++i) {
    if (scores.why[i]) cost.values[i] = std::numeric_limits<double>::infinity();
  }
  if (!chosen_) return found;
  const auto& poses = found.arrays["pose"];
  const std::size_t size = 3 * poses.shape[1];
  const auto first = poses.values.begin() + static_cast<std::ptrdiff_t>(*chosen_ * size);
  found.arrays["chosen"] = {{first, first + static_cast<std::ptrdiff_t>(size)}, {poses.shape[1], 3}};
  Array& chosen = found.arrays["chosen_score"];
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    chosen.values.push_back(scores.raw[c * count + *chosen_] * scores.scale[c]);
  }
  if (!scores.added.empty()) chosen.values.push_back(scores.added[*chosen_]);
  chosen.shape = {chosen.values.size()};
  return found;
}

ControllerKind dwb() {
  Description<DwbOptions> rows = DwbOptions::nav2();
  for (const auto& group : {DwbOptions::further(), DwbOptions::derived()}) {
    rows.insert(rows.end(), group.begin(), group.end());
  }
  ControllerKind kind;
  kind.make = [rows](const OptionValues& values, const RobotOptions&, RandomKey,
                     std::span<const CriticChoice> critics) {
    std::vector<Dwb::Weighted> weighted;
    for (const CriticChoice& it : critics) weighted.push_back({it.name, it.weight, make_critic(it.name, it.options)});
    return std::make_unique<Dwb>(configured(rows, values, DwbOptions{}), std::move(weighted));
  };
  kind.nav2 = parameters(DwbOptions::nav2());
  kind.further = parameters(DwbOptions::further());
  kind.derived = parameters(DwbOptions::derived());
  kind.critic_options = [](const std::string& name) { return critic_kind(name).options; };
  return kind;
}

}  // namespace mrpbench::local
