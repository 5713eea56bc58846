#include "lacam/timetable.hpp"

#include <functional>

namespace mrpbench::mapf::lacam {

namespace {

/// The first departure to an edge on which a robot is only after half-tick `end`; to one that ends at a vertex at which
/// it is only then.
Tick leave_after(Half end) {
  return (end + 1) / 2;
}
Tick arrive_after(Half end, Tick duration) {
  return end / 2 + 1 - duration;
}

}  // namespace

Timetable::Timetable(const Instance& instance, const Relations& relations, const JointMoves& joint)
    : instance_(instance),
      relations_(relations),
      joint_(joint),
      past_(instance.roadmap().element_count()),
      users_(instance.resources().size()) {
  for (int robot = 0; robot < instance.size(); ++robot) {
    const Beginning& beginning = instance.beginning(robot);
    paths_.push_back(beginning.occupied);
    free_at_.push_back(beginning.free_at);
    for (std::size_t step = 0; step + 1 < beginning.occupied.size(); ++step) close(robot, beginning.occupied[step]);
  }
}

void Timetable::add(const std::vector<Move>& round) {
  std::vector<Tick> departure;
  for (const Move& move : round) departure.push_back(std::max(free_at_[move.robot], after_past(move)));
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < round.size(); ++k) {
      const Tick later = after_round(round[k], round, departure);
      changed |= later > departure[k];
      departure[k] = std::max(departure[k], later);
    }
  }
  for (std::size_t k = 0; k < round.size(); ++k) {
    const Move& move = round[k];
    const Tick leave = departure[k], arrive = leave + duration(move);
    Path& path = paths_[move.robot];
    path.back().end = 2 * leave;
    path.push_back(on_edge(move.edge, leave, arrive));
    close(move.robot, *(path.rbegin() + 1));
    close(move.robot, path.back());
    path.push_back(at_vertex(move.to, arrive, arrive));
    free_at_[move.robot] = arrive;
  }
}

std::vector<Path> Timetable::paths() && {
  for (Path& path : paths_) path.back().end = kForeverHalf;
  return std::move(paths_);
}

Tick Timetable::duration(const Move& move) const {
  const int edge = move.edge - instance_.roadmap().vertex_count();
  return instance_.roadmap().duration(instance_.robots()[move.robot].profile)[edge];
}

/// The first departure after all that other robots did.
Tick Timetable::after_past(const Move& move) const {
  const Tick ticks = duration(move);
  Tick first = 0;
  for (const std::int32_t element : {move.edge, move.to}) {
    const auto after = [&](Half end) { return element == move.edge ? leave_after(end) : arrive_after(end, ticks); };
    for (const Near& near : relations_.row(element)) {
      for (const Past& it : past_[near.element]) {
        if (it.robot == move.robot) continue;
        const Relation relation = near.relation(instance_.reach(move.robot, it.robot));
        if (relation == Relation::exclusive) first = std::max(first, after(it.end));
        if (relation == Relation::ordered) {  // enters and leaves the lane later
          first = std::max({first, it.begin / 2 + 1, (it.end + 1) / 2 + 1 - ticks});
        }
      }
    }
    for (const std::int32_t resource : instance_.resources_of(element)) {
      first = std::max(first, after(full_until(move.robot, resource)));
    }
  }
  return first;
}

/// The first departure that does not meet those who leave in the same round.
Tick Timetable::after_round(const Move& move, const std::vector<Move>& round,
                            const std::vector<Tick>& departure) const {
  Tick first = 0;
  for (std::size_t k = 0; k < round.size(); ++k) {
    const Move& other = round[k];
    if (other.robot == move.robot) continue;
    const Half end = 2 * departure[k];
    if (joint_.excludes(move.robot, move.edge, other.robot, other.from)) first = std::max(first, leave_after(end));
    if (joint_.excludes(move.robot, move.to, other.robot, other.from)) {
      first = std::max(first, arrive_after(end, duration(move)));
    }
  }
  return first;
}

Half Timetable::full_until(int robot, int resource) const {
  int room = instance_.resources()[resource].capacity;
  std::vector<bool> inside(instance_.size());
  for (int other = 0; room > 1 && other < instance_.size(); ++other) {
    inside[other] = other != robot && joint_.uses(paths_[other].back().element, resource);
  }
  room -= static_cast<int>(std::ranges::count(inside, true));
  std::vector<Half> ends;
  for (const Past& it : users_[resource]) {
    if (it.robot != robot && !inside[it.robot]) ends.push_back(it.end);
  }
  if (static_cast<int>(ends.size()) < room) return -1;
  std::ranges::nth_element(ends, ends.begin() + (room - 1), std::greater{});
  return ends[room - 1];
}

void Timetable::close(int robot, const Occupation& occupation) {
  note(past_[occupation.element], {robot, occupation.begin, occupation.end});
  for (const std::int32_t resource : instance_.resources_of(occupation.element)) {
    const Half setup = 2 * instance_.resources()[resource].setup;
    note(users_[resource], {robot, occupation.begin, occupation.end + setup});
  }
}

void Timetable::note(std::vector<Past>& pasts, Past past) {
  const auto known = std::ranges::find(pasts, past.robot, &Past::robot);
  if (known == pasts.end()) {
    pasts.push_back(past);
  } else {
    *known = past;
  }
}

}  // namespace mrpbench::mapf::lacam
