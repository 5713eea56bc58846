#include "lns/traffic.hpp"

#include <algorithm>

namespace mrpbench::mapf::lns {

namespace {

/// What else is forbidden on lanes follows, where all moves take one tick.
bool has_unit_moves(const Instance& instance) {
  if (instance.rules().k > 0) return false;
  if (instance.footprints() || !instance.resources().empty() || instance.rules().following_forbidden) return false;
  const auto committed = [](const Robot& robot) { return !robot.committed.empty(); };  // perhaps to slow moves
  if (std::ranges::any_of(instance.robots(), committed)) return false;
  for (int profile = 0; profile < instance.roadmap().profile_count(); ++profile) {
    if (std::ranges::any_of(instance.roadmap().duration(profile), [](Tick ticks) { return ticks > 1; })) return false;
  }
  return true;
}

}  // namespace

Traffic::Traffic(const Instance& instance, const Relations& relations, Limits& limits)
    : instance_(instance),
      relations_(relations),
      limits_(limits),
      unit_(has_unit_moves(instance)),
      vertex_count_(instance.roadmap().vertex_count()),
      users_(instance) {
  limits.charge(static_cast<std::size_t>(instance.roadmap().element_count()) * sizeof(visits_.front()));
  visits_.resize(instance.roadmap().element_count());
}

void Traffic::add(int robot, std::span<const Occupation> path) {
  users_.add(robot, path);
  for (const Occupation& it : path) {
    if (unit_ && it.element >= vertex_count_) continue;
    std::vector<Visit>& visits = visits_[it.element];
    if (visits.size() == visits.capacity()) {
      const std::size_t more = std::max<std::size_t>(4, visits.size());
      limits_.charge(more * sizeof(Visit));
      visits.reserve(visits.size() + more);
    }
    auto place = visits.end();
    while (place != visits.begin() && (place - 1)->begin > it.begin) --place;
    visits.insert(place, {it.begin, it.end, robot});
  }
}

void Traffic::remove(int robot, std::span<const Occupation> path) {
  users_.remove(robot, path);
  for (const Occupation& it : path) {
    if (unit_ && it.element >= vertex_count_) continue;
    std::vector<Visit>& visits = visits_[it.element];
    visits.erase(std::ranges::find_if(visits, [&](const Visit& v) { return v.robot == robot && v.begin == it.begin; }));
  }
}

}  // namespace mrpbench::mapf::lns
