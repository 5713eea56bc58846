#include "mrpbench_mapf/single_agent/reservations.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace mrpbench::mapf {

Reservations::Reservations(const Instance& instance, const Relations& relations, Limits& limits)
    : instance_(instance), relations_(relations), limits_(limits) {
  limits.charge(static_cast<std::size_t>(instance.roadmap().element_count()) * sizeof(std::int32_t));
  head_.assign(instance.roadmap().element_count(), -1);
  users_.resize(instance.resources().size());
}

void Reservations::add(int robot, std::span<const Occupation> occupations) {
  std::int32_t step = 0;
  for (const Occupation& occupation : occupations) {
    std::int32_t& head = head_[occupation.element];
    if (head < 0) touched_.push_back(occupation.element);
    entries_.push_back({robot, step++, occupation.begin, occupation.end, head});
    head = static_cast<std::int32_t>(entries_.size()) - 1;
  }
  for (const auto& [resource, halves] : uses(instance_, occupations)) users_[resource].push_back({robot, halves});
  limits_.charge_growth(counted_, entries_.capacity() * sizeof(Entry));
}

void Reservations::clear() {
  for (const std::int32_t element : touched_) head_[element] = -1;
  touched_.clear();
  entries_.clear();
  for (std::vector<User>& it : users_) it.clear();
}

void Reservations::full(int robot, int resource, std::vector<Range>& halves) const {
  const Resource& it = instance_.resources()[resource];
  const auto add = [&](Half first, Half last) {  // before the first, its own setup would reach into it
    const std::int64_t since = first - std::int64_t{2} * it.setup;
    halves.push_back({static_cast<Half>(std::max<std::int64_t>(since, 0)), last});
  };
  if (it.capacity == 1) {
    for (const User& use : users_[resource]) {
      if (use.robot != robot) add(use.halves.first, use.halves.last);
    }
    return;
  }
  std::vector<User> others;
  std::ranges::copy_if(users_[resource], std::back_inserter(others), [&](const User& it) { return it.robot != robot; });
  std::ranges::sort(others, [](const User& a, const User& b) {
    return a.robot != b.robot ? a.robot < b.robot : a.halves.first < b.halves.first;
  });
  std::vector<std::pair<Half, int>> changes;  // of the number of robots, at half-ticks
  for (std::size_t i = 0; i < others.size();) {
    Range whole = others[i].halves;
    const std::int32_t who = others[i].robot;
    for (++i; i < others.size() && others[i].robot == who && others[i].halves.first <= whole.last + 1; ++i) {
      whole.last = std::max(whole.last, others[i].halves.last);
    }
    changes.push_back({whole.first, 1});
    changes.push_back({whole.last + 1, -1});
  }
  std::ranges::sort(changes);
  int count = 0;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    count += changes[i].second;
    if (count >= it.capacity && changes[i + 1].first > changes[i].first)
      add(changes[i].first, changes[i + 1].first - 1);
  }
}

void Reservations::at_vertex(int robot, int vertex, std::vector<Range>& halves) const {
  for (const Near& near : relations_.row(vertex)) {
    for (std::int32_t k = head_[near.element]; k >= 0; k = entries_[k].next) {
      const Entry& entry = entries_[k];
      if (entry.robot == robot || near.distance >= instance_.reach(robot, entry.robot)) continue;
      halves.push_back({entry.begin, entry.end});
    }
  }
  for (const std::int32_t resource : instance_.resources_of(vertex)) full(robot, resource, halves);
}

void Reservations::on_edge(int robot, int edge, Tick duration, std::vector<Range>& departures) const {
  for (const Near& near : relations_.row(instance_.roadmap().vertex_count() + edge)) {
    for (std::int32_t k = head_[near.element]; k >= 0; k = entries_[k].next) {
      const Entry& entry = entries_[k];
      if (entry.robot == robot) continue;
      switch (near.relation(instance_.reach(robot, entry.robot))) {
        case Relation::exclusive:  // [2d+1, 2(d+duration)-1] must not meet [begin, end]
          departures.push_back({entry.begin / 2 + 1 - duration, (entry.end - 1) >> 1});
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
  std::vector<Range> halves;
  for (const std::int32_t resource : instance_.resources_of(instance_.roadmap().vertex_count() + edge)) {
    full(robot, resource, halves);
  }
  for (const Range& it : halves) {
    const Range hit{it.first / 2 + 1 - duration, (it.last - 1) >> 1};
    if (hit.first <= hit.last) departures.push_back(hit);
  }
}

void reserve_beginnings(const Instance& instance, Reservations& reservations) {
  for (int robot = 0; robot < instance.size(); ++robot) {
    const Beginning& beginning = instance.beginning(robot);
    if (beginning.occupied.size() > 1 || beginning.free_at > 0) reservations.add(robot, beginning.occupied);
  }
}

}  // namespace mrpbench::mapf
