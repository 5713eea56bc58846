#include "mrpbench_sim/contacts.hpp"

#include <algorithm>

namespace mrpbench::sim {

namespace {

constexpr int kRounds = 20;
constexpr double kTouch = 1e-9;

/// Straight from a segment, solid on its left, to a point; to its right from a point on it.
Point away(const Segment& wall, Point centre) {
  const Point offset = gap(wall, centre);
  const double distance = length(offset);
  if (distance > 0) return offset * (1 / distance);
  const Point along = wall.end - wall.start;
  return Point{along.y, -along.x} * (1 / std::max(length(along), 1e-300));
}

}  // namespace

Contacts::Contacts(std::vector<Segment> segments, std::vector<double> radius, int robots)
    : neighbours_(std::move(segments), std::move(radius), robots),
      is_active_(static_cast<std::size_t>(robots)),
      is_back_(static_cast<std::size_t>(robots)) {}

void Contacts::separate(std::span<const Point> before, std::span<Point> centres, std::vector<Touch>& touches) {
  for (int round = 0; round < kRounds; ++round) {
    neighbours_.refresh(centres);
    activate(round == 0);
    shifts_.clear();
    for (const int robot : active_) {
      Point shift;
      if (push(robot, before, centres, shift, touches)) shifts_.push_back({robot, shift});
    }
    if (shifts_.empty()) return;
    for (const Shift& it : shifts_) {
      Point& centre = centres[static_cast<std::size_t>(it.robot)];
      centre = centre + it.by;
    }
  }
  take_back(before, centres);
}

/// After the first round, only discs that were pushed and their neighbours can overlap.
void Contacts::activate(bool all) {
  active_.clear();
  if (all) {
    for (int robot = 0; robot < neighbours_.robots(); ++robot) active_.push_back(robot);
    return;
  }
  std::fill(is_active_.begin(), is_active_.end(), 0);
  const auto add = [&](int robot) {
    char& known = is_active_[static_cast<std::size_t>(robot)];
    if (!known) active_.push_back(robot);
    known = 1;
  };
  for (const Shift& it : shifts_) {
    add(it.robot);
    for (const int other : neighbours_.discs(it.robot)) {
      if (other < neighbours_.robots()) add(other);
    }
  }
}

/// Whether a robot overlaps anything, and where that pushes it: two robots share the displacement, movers and walls do
/// not move. A robot that a mover would push into a wall stays where it was.
bool Contacts::push(int robot, std::span<const Point> before, std::span<const Point> centres, Point& shift,
                    std::vector<Touch>& touches) const {
  bool pushed = false, by_mover = false;
  const Point centre = centres[static_cast<std::size_t>(robot)];
  for (const int other : neighbours_.discs(robot)) {
    // Computed from the lower index, so that both robots of a pair get bit-identical results.
    const int low = std::min(robot, other), high = std::max(robot, other);
    const Point offset = centres[static_cast<std::size_t>(high)] - centres[static_cast<std::size_t>(low)];
    const double spacing = neighbours_.radius(low) + neighbours_.radius(high);
    if (dot(offset, offset) > spacing * spacing) continue;
    const double distance = length(offset);
    if (!(distance < spacing - kTouch)) continue;
    pushed = true;
    const bool both = high < neighbours_.robots();
    by_mover |= !both;
    if (robot == low) touches.push_back({low, high});
    const Point direction = distance > 0 ? offset * (1 / distance) : Point{1, 0};
    const double way = (spacing - distance) * (both ? 0.5 : 1.0);
    shift = robot == low ? shift - direction * way : shift + direction * way;
  }
  // A robot is pushed out of the wall that it overlaps most; later rounds handle the others.
  const Inside inside = deepest_wall(robot, centre);
  if (inside.wall >= 0) {
    touches.push_back({robot, -1});
    shift = away(neighbours_.segment(inside.wall), centre) * inside.depth;
    return true;
  }
  if (by_mover && deepest_wall(robot, centre + shift).wall >= 0)
    shift = before[static_cast<std::size_t>(robot)] - centre;
  return pushed;
}

/// The wall that a robot at `centre` overlaps most, -1 = none.
Contacts::Inside Contacts::deepest_wall(int robot, Point centre) const {
  Inside found{-1, kTouch};
  for (const int it : neighbours_.walls(robot)) {
    const double depth = neighbours_.radius(robot) - length(gap(neighbours_.segment(it), centre));
    if (depth < found.depth || depth <= kTouch) continue;
    found = {it, depth};
  }
  return found;
}

/// Undo the motion of robots that still overlap too much, and of robots that overlap those after that.
void Contacts::take_back(std::span<const Point> before, std::span<Point> centres) {
  std::fill(is_back_.begin(), is_back_.end(), 0);
  do {
    neighbours_.refresh(centres);
    active_.clear();
    for (int robot = 0; robot < neighbours_.robots(); ++robot) {
      if (!is_back_[static_cast<std::size_t>(robot)] && stuck(robot, centres)) active_.push_back(robot);
    }
    for (const int robot : active_) {
      const auto at = static_cast<std::size_t>(robot);
      is_back_[at] = 1;
      centres[at] = before[at];
    }
  } while (!active_.empty());
}

bool Contacts::stuck(int robot, std::span<const Point> centres) const {
  const Point centre = centres[static_cast<std::size_t>(robot)];
  for (const int other : neighbours_.discs(robot)) {
    const double spacing = neighbours_.radius(robot) + neighbours_.radius(other);
    if (length(centres[static_cast<std::size_t>(other)] - centre) < spacing - kTolerance) return true;
  }
  for (const int wall : neighbours_.walls(robot)) {
    if (neighbours_.radius(robot) - length(gap(neighbours_.segment(wall), centre)) > kTolerance) return true;
  }
  return false;
}

}  // namespace mrpbench::sim
