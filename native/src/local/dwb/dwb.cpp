#include "mrpbench_local/dwb/dwb.hpp"

#include <algorithm>
#include <array>
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

/// The lowest total of those that are legal, infinite if none is.
MRPBENCH_WIDE double lowest_legal(std::size_t count, const double* total, const Reason* why) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 8> lowest;  // of every eighth
  lowest.fill(kInfinity);
  std::size_t i = 0;
  for (; i + lowest.size() <= count; i += lowest.size()) {
    for (std::size_t k = 0; k < lowest.size(); ++k) {
      const double it = why[i + k] ? kInfinity : total[i + k];
      lowest[k] = it < lowest[k] ? it : lowest[k];
    }
  }
  double found = *std::ranges::min_element(lowest);
  for (; i < count; ++i) found = !why[i] && total[i] < found ? total[i] : found;
  return found;
}

}  // namespace

/// What one command needs, shared by the robots that a thread controls one after the other, so that it stays in its
/// cache.
struct Dwb::Buffers {
  Trajectories all;
  PathGrid path;
  EndCells ends;
  /// What critics say: raw scores, critic by critic, and what they are multiplied by.
  std::vector<double> raw, scale, total;
  std::vector<Reason> why;
  /// The critic that says why, -1 = none.
  std::vector<int> dropped;
  bool complete = false;
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
  debrief();
  if (is_new(goal_, path)) {
    goal_ = {end.x, end.y, path.yaw};
    for (const Weighted& each : critics_) each.critic->reset();
    rotate_.begin(pose, path);
  }
  if (std::isnan(path.yaw) && sim::length({pose.x - end.x, pose.y - end.y}) <= frame.resolution) return Twist{};
  if (const auto turn = rotate_.command(pose, path, *it.costmap)) return turn;
  for (const Weighted& each : critics_) __builtin_prefetch(each.critic.get());
  Buffers& its = Buffers::of_thread();
  const std::size_t points = its.path.take(frame, {pose.x, pose.y}, path.first, path.rest, options_.pruning);
  const Twist measured{thresholded(it.twist.ahead, options_.min_x_velocity_threshold),
                       thresholded(it.twist.turn, options_.min_theta_velocity_threshold)};
  sampled_.scene = {it.now, pose, measured, *goal_, path.tolerance, it.costmap, nullptr, nullptr, it.forecast};
  sampled_.path.assign(1, path.first);
  sampled_.path.insert(sampled_.path.end(), path.rest.begin(), path.rest.begin() + static_cast<std::ptrdiff_t>(points));
  sampled_.speed = path.speed;
  sampled_.added.clear();
  has_sampled_ = true;
  const Scene scene = sample(its);
  score(scene, its);
  if (extra) {
    sampled_.added.assign(its.all.size(), 0);
    extra(samples_of(its.all), sampled_.added);
    for (std::size_t i = 0; i < its.all.size(); ++i) its.total[i] += sampled_.added[i];
  }
  chosen_ = best(scene, its);
  command_ = chosen_ ? its.all.twist(*chosen_) : Twist{};
  if (!chosen_) return std::nullopt;
  return command_;
}

/// Tell the critics what was commanded last. Not before the next command, so that they score in `explain` as they did.
void Dwb::debrief() {
  if (has_sampled_) {
    for (const Weighted& it : critics_) it.critic->debrief(sampled_.scene, command_);
  }
  has_sampled_ = false;
  chosen_.reset();
}

/// The speed from which a robot can still brake at half a cell before the end of its path, `left` metres ahead.
double Dwb::speed_to_stop(double left, double cell) const {
  return std::sqrt(-2 * options_.motion.decel_lim_x * (std::max(left, cell) - cell / 2));
}

Dwb::Buffers& Dwb::Buffers::of_thread() {
  thread_local Buffers buffers;
  return buffers;
}

/// Trajectories along the path that was taken, and all that critics need to score them.
Scene Dwb::sample(Buffers& its) const {
  Scene scene = sampled_.scene;
  const Frame& frame = scene.costmap->frame();
  const double fastest = std::min(sampled_.speed, speed_to_stop(its.path.left(), frame.resolution));
  its.all.generate(options_.motion, scene.pose, scene.twist, fastest);
  its.ends.begin(frame, its.all);
  if (!its.path.empty()) {
    const EndCells::Cells& ends = its.ends.ahead(0);
    const Cell robot = frame.cell({scene.pose.x, scene.pose.y});
    const int ahead = whole_below(looks_ahead_ / frame.resolution) + 1;
    its.path.spread(frame, {std::min(ends.low.x, robot.x) - ahead, std::min(ends.low.y, robot.y) - ahead},
                    {std::max(ends.high.x, robot.x) + ahead, std::max(ends.high.y, robot.y) + ahead});
  }
  scene.path = &its.path;
  scene.ends = &its.ends;
  return scene;
}

/// Totals of all trajectories, from critics that need only their last poses.
void Dwb::score(const Scene& scene, Buffers& its) const {
  const std::size_t count = its.all.size();
  its.total.assign(count, 0);
  its.why.assign(count, kLegal);
  its.dropped.assign(count, -1);
  its.raw.resize(count * critics_.size());
  its.scale.assign(critics_.size(), 0);
  its.complete = false;
  its.fault.resize(count, kLegal);  // it is full of that
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    const Weighted& it = critics_[c];
    it.critic->prepare(scene);
    const std::span<double> raw(&its.raw[c * count], count);
    const double scale = its.scale[c] = it.scale * it.critic->weight(scene);
    if (scale == 0) continue;
    const bool faulty = it.critic->score(scene, its.all, raw, its.fault);
    add_scaled(count, raw.data(), scale, its.total.data());
    for (std::size_t i = 0; faulty && i < count; ++i) {
      if (!its.fault[i]) continue;
      if (!its.why[i]) {
        its.why[i] = its.fault[i];
        its.dropped[i] = static_cast<int>(c);
      }
      its.fault[i] = kLegal;
    }
  }
}

/// Let critics say of all trajectories what they left open.
void Dwb::complete(const Scene& scene, Buffers& its) const {
  if (its.complete) return;
  its.complete = true;
  const std::size_t count = its.all.size();
  std::vector<Reason> fault(count, kLegal);
  const auto total = [&](std::size_t i) {
    double sum = 0;
    for (std::size_t c = 0; c < critics_.size(); ++c) {
      if (its.scale[c] != 0) sum += its.raw[c * count + i] * its.scale[c];
    }
    return sampled_.added.empty() ? sum : sum + sampled_.added[i];
  };
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    const std::span<double> raw(&its.raw[c * count], count);
    if (its.scale[c] == 0 || !critics_[c].critic->complete(scene, its.all, raw, fault)) continue;
    for (std::size_t i = 0; i < count; ++i) {
      if (!fault[i]) continue;
      if (!its.why[i] || its.dropped[i] > static_cast<int>(c)) {
        its.why[i] = fault[i];
        its.dropped[i] = static_cast<int>(c);
      }
      its.total[i] = total(i);
      fault[i] = kLegal;
    }
  }
}

/// Check all poses of a trajectory.
bool Dwb::passes(const Scene& scene, Buffers& its, std::size_t i) const {
  Reason& why = its.why[i];
  for (std::size_t c = 0; !its.complete && c < critics_.size(); ++c) {
    if (its.scale[c] == 0) continue;
    why = critics_[c].critic->check_end(scene, its.all, i);
    if (!why) continue;
    its.dropped[i] = static_cast<int>(c);
    return false;
  }
  return its.all.walk(i, [&](Pose pose) {
    for (std::size_t c = 0; c < critics_.size(); ++c) {
      const Weighted& it = critics_[c];
      if (it.scale == 0) continue;
      why = it.critic->check(scene, pose);
      if (!why) continue;
      its.dropped[i] = static_cast<int>(c);
      return false;
    }
    return true;
  });
}

/// The trajectory with the lowest total, of equal ones the first. Trajectories that cannot win by their totals are not
/// checked pose by pose: DWB's short-circuit evaluation, applied to whole trajectories. Nor are their ends: what
/// critics leave open only makes trajectories illegal.
std::optional<std::size_t> Dwb::best(const Scene& scene, Buffers& its) const {
  const std::vector<double>& total = its.total;
  const auto may_win = [&](std::size_t i) { return !its.why[i] && total[i] < std::numeric_limits<double>::infinity(); };
  if (!options_.short_circuit) complete(scene, its);
  for (std::size_t i = 0; !options_.short_circuit && i < its.all.size(); ++i) {
    if (may_win(i)) passes(scene, its, i);
  }
  const double lowest = lowest_legal(its.all.size(), total.data(), its.why.data());
  std::optional<std::size_t> first;
  for (std::size_t i = 0; !first && i < its.all.size(); ++i) {
    if (total[i] == lowest && may_win(i)) first = i;
  }
  if (!first || passes(scene, its, *first)) return first;
  its.order.clear();
  for (std::size_t i = 0; i < its.all.size(); ++i) {
    if (may_win(i)) its.order.push_back(i);
  }
  const auto worse = [&](std::size_t a, std::size_t b) { return total[a] != total[b] ? total[a] > total[b] : a > b; };
  std::ranges::make_heap(its.order, worse);
  for (; !its.order.empty(); its.order.pop_back()) {
    if (passes(scene, its, its.order.front())) return its.order.front();
    std::ranges::pop_heap(its.order, worse);
  }
  return std::nullopt;
}

Explanation Dwb::explain() const {
  Explanation found;
  if (!has_sampled_) return found;
  Buffers its;
  const Point robot{sampled_.scene.pose.x, sampled_.scene.pose.y};
  its.path.take(sampled_.scene.costmap->frame(), robot, sampled_.path[0], std::span(sampled_.path).subspan(1),
                options_.pruning);
  const Scene scene = sample(its);
  score(scene, its);
  for (std::size_t i = 0; i < sampled_.added.size(); ++i) its.total[i] += sampled_.added[i];
  const std::size_t count = its.all.size();
  if (count == 0) return found;
  best(scene, its);
  complete(scene, its);
  Samples samples = samples_of(its.all);
  found.arrays = {{"twist", std::move(samples.twist)},
                  {"pose", std::move(samples.pose)},
                  {"score", {its.raw, {critics_.size(), count}}},
                  {"total", {its.total, {count}}}};
  for (const Weighted& it : critics_) found.words["critics"].push_back(it.name);
  std::vector<std::string>& reasons = found.words["reason"];
  for (std::size_t i = 0; i < count; ++i) {
    const int critic = its.dropped[i];
    reasons.push_back(critic < 0 ? "" : critics_[static_cast<std::size_t>(critic)].name + ": " + its.why[i]);
  }
  Array& cost = found.arrays["cost"] = {its.total, {count}};
  for (std::size_t i = 0; i < count; ++i) {
    if (its.why[i]) cost.values[i] = std::numeric_limits<double>::infinity();
  }
  if (!chosen_) return found;
  const auto& poses = found.arrays["pose"];
  const std::size_t size = 3 * poses.shape[1];
  const auto first = poses.values.begin() + static_cast<std::ptrdiff_t>(*chosen_ * size);
  found.arrays["chosen"] = {{first, first + static_cast<std::ptrdiff_t>(size)}, {poses.shape[1], 3}};
  Array& chosen = found.arrays["chosen_score"];
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    chosen.values.push_back(its.raw[c * count + *chosen_] * its.scale[c]);
  }
  if (!sampled_.added.empty()) chosen.values.push_back(sampled_.added[*chosen_]);
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
