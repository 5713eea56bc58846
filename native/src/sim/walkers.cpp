#include "mrpbench_sim/walkers.hpp"

#include <numbers>
#include <stdexcept>

namespace mrpbench::sim {

namespace {

constexpr double kLongest = 0.05;   // seconds of a sub-step
constexpr double kWallSight = 3;    // metres
constexpr std::size_t kMost = 10;   // neighbours whose velocity obstacles count
constexpr double kBodies = 0.55;    // metres between the centres of members of a group that overlap
constexpr double kToRobots = 0.05;  // metres that people leave between themselves and a robot
constexpr double kStepBack = 0.5;   // share of their speed with which they step back, so that they can still go round
constexpr double kLeast = 1e-9;

Point unit(Point p) {
  const double size = length(p);
  return size > kLeast ? p * (1 / size) : Point{};
}

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace

Description<WalkerOptions> WalkerOptions::description() {
  return {
      {"interaction", &WalkerOptions::interaction, at_least(0), "strength of the force between people, m/s²"},
      {"relaxation", &WalkerOptions::relaxation, within(0.05, 10), "seconds in which people take up their speed"},
      {"goal_factor", &WalkerOptions::goal_factor, at_least(0), "weight of the force towards the goal"},
      {"wall_force", &WalkerOptions::wall_force, at_least(0), "force of a wall that is touched, m/s²"},
      {"wall_reach", &WalkerOptions::wall_reach, within(0.01, 10), "metres over which it falls to 1/e"},
      {"side", &WalkerOptions::side, within(-1, 1), "preference for a side of who meets head-on; above 0 = the right"},
      {"gaze", &WalkerOptions::gaze, at_least(0), "weight in groups of slowing down to see the others"},
      {"coherence", &WalkerOptions::coherence, at_least(0), "weight in groups of staying together"},
      {"repulsion", &WalkerOptions::repulsion, at_least(0), "weight in groups of not overlapping"},
      {"horizon", &WalkerOptions::horizon, within(0.1, 60), "seconds ahead for which orca avoids people and robots"},
      {"wall_horizon", &WalkerOptions::wall_horizon, within(0.1, 60), "seconds ahead for which orca avoids walls"},
      {"sight", &WalkerOptions::sight, within(0.5, 100), "metres within which people see others"},
  };
}

Walkers::Walkers(std::vector<Segment> segments, std::vector<double> radius, std::vector<double> speed,
                 std::vector<int> group, std::vector<Point> places, const WalkerOptions& options,
                 std::vector<Point> velocities)
    : segments_(std::move(segments)),
      radius_(std::move(radius)),
      speed_(std::move(speed)),
      group_(std::move(group)),
      places_(std::move(places)),
      velocities_(std::move(velocities)),
      next_(places_.size()),
      options_(options),
      buckets_(segments_, kWallSight, 1),
      hash_(options.sight / 2) {
  const std::size_t count = places_.size();
  velocities_.resize(count);
  require(radius_.size() == count && speed_.size() == count && group_.size() == count, "one entry for each person");
  for (const double it : radius_) require(it > 0 && std::isfinite(it), "radii must be positive");
  for (const double it : speed_) require(it >= 0 && std::isfinite(it), "speeds must not be negative");
  for (const Point it : places_) require(somewhere(it), "places must be finite");
  for (std::size_t me = 0; me < count; ++me) {
    if (group_[me] < 0) continue;
    if (groups_.size() <= static_cast<std::size_t>(group_[me]))
      groups_.resize(static_cast<std::size_t>(group_[me]) + 1);
    groups_[static_cast<std::size_t>(group_[me])].push_back(me);
  }
}

void Walkers::step(double dt, const Wishes& wishes, std::span<const Walker> others, std::span<const double> radius,
                   std::size_t robots, std::span<const Segment> leaves) {
  require(dt > 0 && std::isfinite(dt), "the period must be positive");
  require(wishes.velocity.size() == size() && wishes.push.size() == size() && wishes.regard.size() == size(),
          "one wish for each person");
  require(others.size() == radius.size() && robots <= others.size(), "a radius for each robot and mover");
  for (std::size_t i = 0; i < size(); ++i) {
    require(somewhere(wishes.velocity[i]) && somewhere(wishes.push[i]), "wishes must be finite");
  }
  if (!contacts_ || !std::equal(radius.begin(), radius.end(), others_radius_.begin(), others_radius_.end())) {
    others_radius_.assign(radius.begin(), radius.end());
    std::vector<double> all = radius_;
    all.insert(all.end(), radius.begin(), radius.end());
    contacts_.emplace(segments_, std::move(all), static_cast<int>(size()));
  }
  contacts_->set_leaves(leaves);
  largest_robot_ = 0;
  for (std::size_t i = 0; i < robots; ++i) largest_robot_ = std::max(largest_robot_, radius[i]);
  // In a sub-step nobody moves farther than a quarter of the smallest radius, so that nobody passes through anything.
  double steps = dt / kLongest;
  for (std::size_t i = 0; i < size(); ++i) steps = std::max(steps, dt * speed_[i] / (radius_[i] / 4));
  const auto count = std::max(1, static_cast<int>(std::ceil(steps - kLeast)));
  const std::vector<Point> begin = places_;
  const Scene scene{wishes, others, radius, robots, leaves};
  for (int i = 0; i < count; ++i) move(dt / count, scene);
  for (std::size_t i = 0; i < size(); ++i) velocities_[i] = (places_[i] - begin[i]) * (1 / dt);
}

/// Decide all velocities from the same state, then move, and let contacts push people apart, out of walls and robots.
void Walkers::move(double dt, const Scene& scene) {
  std::vector<Point> centres = places_;
  for (const Walker& it : scene.others) centres.push_back(it.place);
  hash_.build(centres);
  for (std::size_t me = 0; me < size(); ++me) {
    next_[me] = beside_robots(me, dt, scene, options_.orca ? avoided(me, dt, scene) : forced(me, dt, scene));
  }
  const std::vector<Point> before = centres;
  for (std::size_t me = 0; me < size(); ++me) centres[me] = centres[me] + next_[me] * dt;
  touches_.clear();
  contacts_->separate(before, centres, touches_);
  for (std::size_t me = 0; me < size(); ++me) {
    velocities_[me] = (centres[me] - places_[me]) * (1 / dt);
    places_[me] = centres[me];
  }
}

Walker Walkers::walker(std::size_t disc, const Scene& scene) const {
  return disc < size() ? Walker{places_[disc], velocities_[disc]} : scene.others[disc - size()];
}

/// Calls `visit(offset)` with the way from the nearest point of each segment nearby that faces a point.
template <class Visit>
void Walkers::walls(Point centre, const Scene& scene, Visit&& visit) const {
  const auto see = [&](const Segment& it) {
    const Point along = it.end - it.start, offset = centre - it.start;
    if (along.x * offset.y - along.y * offset.x <= 0) visit(gap(it, centre));  // what is solid is on the left
  };
  for (const std::int32_t it : buckets_.near(centre)) see(segments_[static_cast<std::size_t>(it)]);
  for (const Segment& it : scene.leaves) see(it);
}

Point Walkers::forced(std::size_t me, double dt, const Scene& scene) const {
  const Walker self{places_[me], velocities_[me]};
  const Point wanted = scene.wishes.velocity[me];
  Point force = (wanted - self.velocity) * (options_.goal_factor / options_.relaxation) + scene.wishes.push[me];
  // Who wants to stand stands until somebody touches it; forces would let it drift away from walls.
  if (wanted == Point{} && scene.wishes.push[me] == Point{}) return self.velocity + force * dt;
  double nearest = kWallSight;
  Point away;
  const auto block = [&](Point offset, double size) {
    if (size < nearest) nearest = size, away = offset;
  };
  walls(self.place, scene, [&](Point offset) { block(offset, length(offset)); });
  const unsigned char regard = scene.wishes.regard[me];
  hash_.near(self.place, options_.sight, [&](int index) {
    const auto disc = static_cast<std::size_t>(index);
    if (disc == me || (disc < size() && group_[me] >= 0 && group_[disc] == group_[me])) return;
    const Walker other = walker(disc, scene);
    const Point offset = self.place - other.place;
    if (dot(offset, offset) > options_.sight * options_.sight) return;
    const bool robot = disc >= size() && disc < size() + scene.robots;
    if (robot && regard == not_at_all) return;
    if (robot && regard == as_obstacles) return block(offset, length(offset));
    force = force + social_force(self, other, options_.interaction, options_.side);
  });
  if (nearest < kWallSight) {
    force = force + unit(away) * (options_.wall_force * std::exp((radius_[me] - nearest) / options_.wall_reach));
  }
  if (group_[me] >= 0) force = force + of_group(me, wanted);
  return self.velocity + force * dt;
}

/// The forces within groups (M. Moussaïd et al., "The walking behaviour of pedestrian social groups and its impact on
/// crowd dynamics", PLoS ONE 5, 2010): slow down to see the others, stay together, do not overlap.
Point Walkers::of_group(std::size_t me, Point wanted) const {
  const auto& members = groups_[static_cast<std::size_t>(group_[me])];
  if (members.size() < 2) return {};
  Point others, apart;
  for (const std::size_t it : members) {
    if (it == me) continue;
    others = others + places_[it];
    const Point offset = places_[me] - places_[it];
    if (length(offset) < kBodies) apart = apart + unit(offset);
  }
  const double rest = static_cast<double>(members.size()) - 1;
  others = others * (1 / rest);
  const Point centre = (others * rest + places_[me]) * (1 / (rest + 1));
  const Point towards = others - places_[me];
  double turn = 0;
  if (length(towards) > kLeast && length(wanted) > kLeast) {
    const double angle = std::acos(std::clamp(dot(unit(towards), unit(wanted)), -1.0, 1.0));
    turn = std::max(0.0, angle - std::numbers::pi / 2);
  }
  Point force = velocities_[me] * (-options_.gaze * turn) + apart * options_.repulsion;
  if (length(centre - places_[me]) > rest / 2) force = force + unit(centre - places_[me]) * options_.coherence;
  return force;
}

/// The velocity within the person's speed that is nearest to `wanted` and leaves some room to each robot; to one that
/// has come nearer, the person steps back. Neither forces nor velocity obstacles forbid to walk into a robot.
Point Walkers::beside_robots(std::size_t me, double dt, const Scene& scene, Point wanted) const {
  std::vector<HalfPlane> planes;
  const double reach = radius_[me] + largest_robot_ + kToRobots + speed_[me] * dt;
  hash_.near(places_[me], reach, [&](int index) {
    const auto disc = static_cast<std::size_t>(index);
    if (disc < size() || disc >= size() + scene.robots) return;
    const Point offset = places_[me] - scene.others[disc - size()].place;
    const double distance = length(offset);
    const double room = distance - radius_[me] - scene.radius[disc - size()] - kToRobots;
    if (distance < kLeast || room > speed_[me] * dt) return;
    const Point away = offset * (1 / distance);
    planes.push_back({away * std::min(-room / dt, kStepBack * speed_[me]), {away.y, -away.x}});
  });
  return nearest_velocity(planes, 0, speed_[me], wanted);
}

Point Walkers::avoided(std::size_t me, double dt, const Scene& scene) const {
  const Walker self{places_[me], velocities_[me]};
  std::vector<HalfPlane> planes;
  walls(self.place, scene, [&](Point offset) {
    const double distance = length(offset), free = std::max(0.0, distance - radius_[me]);
    if (distance < kLeast || free > speed_[me] * options_.wall_horizon) return;
    const Point away = offset * (1 / distance);
    planes.push_back({away * (-free / options_.wall_horizon), {away.y, -away.x}});
  });
  const std::size_t hard = planes.size();
  struct Near {
    double squared;
    std::size_t disc;
  };
  std::vector<Near> near;
  hash_.near(self.place, options_.sight, [&](int index) {
    const auto disc = static_cast<std::size_t>(index);
    const bool robot = disc >= size() && disc < size() + scene.robots;
    if (disc == me || (robot && scene.wishes.regard[me] == not_at_all)) return;
    const Point offset = walker(disc, scene).place - self.place;
    const double squared = dot(offset, offset);
    if (squared <= options_.sight * options_.sight) near.push_back({squared, disc});
  });
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) {
    return a.squared != b.squared ? a.squared < b.squared : a.disc < b.disc;
  });
  if (near.size() > kMost) near.resize(kMost);
  for (const Near& it : near) {
    const bool person = it.disc < size();
    const double radii = radius_[me] + (person ? radius_[it.disc] : scene.radius[it.disc - size()]);
    planes.push_back(avoiding(self, walker(it.disc, scene), radii, options_.horizon, dt, person ? 0.5 : 1));
  }
  const Point wanted = scene.wishes.velocity[me] + scene.wishes.push[me] * options_.relaxation;
  return nearest_velocity(planes, hard, speed_[me], wanted);
}

}  // namespace mrpbench::sim
