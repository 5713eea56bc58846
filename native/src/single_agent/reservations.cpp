#include "mrpbench_mapf/single_agent/reservations.hpp"

#include <algorithm>

namespace mrpbench::mapf {

Reservations::Reservations(const Instance& instance, const Relations& relations, Limits& limits)
    : instance_(instance), relations_(relations), limits_(limits), users_(instance) {
  limits.charge(static_cast<std::size_t>(instance.roadmap().element_count()) * sizeof(std::int32_t));
  head_.assign(instance.roadmap().element_count(), -1);
}

void Reservations::add(int robot, std::span<const Occupation> occupations) {
  if (instance_.rules().horizon == kForever) return add_whole(robot, occupations);
  within_.assign(occupations.begin(), occupations.end());
  limit(instance_, within_);
  add_whole(robot, within_);
}

void Reservations::add_whole(int robot, std::span<const Occupation> occupations) {
  std::int32_t step = 0;
  for (const Occupation& occupation : occupations) {
    std::int32_t& head = head_[occupation.element];
    if (head < 0) touched_.push_back(occupation.element);
    entries_.push_back({robot, step++, occupation.begin, occupation.end, head});
    head = static_cast<std::int32_t>(entries_.size()) - 1;
  }
  users_.add(robot, occupations);
  limits_.charge_growth(counted_, entries_.capacity() * sizeof(Entry));
}

void Reservations::clear() {
  for (const std::int32_t element : touched_) head_[element] = -1;
  touched_.clear();
  entries_.clear();
  users_.clear();
}

void Reservations::at_vertex(int robot, int vertex, std::vector<Range>& halves) const {
  for (const Near& near : relations_.row(vertex)) {
    for (std::int32_t k = head_[near.element]; k >= 0; k = entries_[k].next) {
      const Entry& entry = entries_[k];
      if (entry.robot == robot || near.distance >= instance_.reach(robot, entry.robot)) continue;
      halves.push_back(widened(entry.begin, entry.end, instance_.rules().k));
    }
  }
  for (const std::int32_t resource : instance_.resources_of(vertex)) users_.full(robot, resource, halves);
}

void Reservations::on_edge(int robot, int edge, Tick duration, std::vector<Range>& departures) const {
  for (const Near& near : relations_.row(instance_.roadmap().vertex_count() + edge)) {
    for (std::int32_t k = head_[near.element]; k >= 0; k = entries_[k].next) {
      const Entry& entry = entries_[k];
      if (entry.robot == robot) continue;
      switch (near.relation(instance_.reach(robot, entry.robot))) {
        case Relation::exclusive:
          departures.push_back(departures_into(widened(entry.begin, entry.end, instance_.rules().k), duration));
          break;
        case Relation::ordered: {  // in one order both at the entrance and at the exit
          const Tick enter = entry.begin / 2, level = (entry.end + 1) / 2 - duration;
          departures.push_back({std::min(enter, level), std::max(enter, level)});
          break;
        }
        case Relation::none:
          break;
      }
      if (!departures.empty() && departures.back().first > departures.back().last) departures.pop_back();
    }
  }
  for (const std::int32_t resource : instance_.resources_of(instance_.roadmap().vertex_count() + edge)) {
    users_.full_departures(robot, resource, duration, departures);
  }
}

void reserve_beginnings(const Instance& instance, Reservations& reservations) {
  for (int robot = 0; robot < instance.size(); ++robot) {
    const Beginning& beginning = instance.beginning(robot);
    if (beginning.occupied.size() > 1 || beginning.free_at > 0 || instance.rules().k > 0)
      reservations.add(robot, beginning.occupied);
  }
}

}  // namespace mrpbench::mapf
