// Occupations of planned robots, listed by element of the roadmap: the reservation table of Silver, "Cooperative
// Pathfinding", AIIDE 2005, with intervals instead of cells of space-time.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_mapf/model/conflict.hpp"
#include "mrpbench_mapf/single_agent/obstacles.hpp"
#include "mrpbench_mapf/single_agent/resource_users.hpp"

namespace mrpbench::mapf {

class Reservations {
 public:
  Reservations(const Instance& instance, const Relations& relations, Limits& limits);

  /// Reserve what the horizon of the instance leaves of it.
  void add(int robot, std::span<const Occupation> occupations);
  void clear();
  bool empty() const { return entries_.empty(); }

  /// What the occupations of all robots but `robot` mean for it.
  void at_vertex(int robot, int vertex, std::vector<Range>& halves) const;
  void on_edge(int robot, int edge, Tick duration, std::vector<Range>& departures) const;

  /// Call `found(entry, relation)` for every reservation of another robot with which `occupation` conflicts.
  template <class Found>
  void conflicts_of(int robot, const Occupation& occupation, Found found) const {
    const Range late = widened(occupation.begin, occupation.end, instance_.rules().k);
    for (const Near& near : relations_.row(occupation.element)) {
      for (std::int32_t k = head_[near.element]; k >= 0; k = entries_[k].next) {
        const Entry& entry = entries_[k];
        if (entry.robot == robot || entry.begin > late.last || entry.end < late.first) continue;
        const Relation relation = near.relation(instance_.reach(robot, entry.robot));
        if (relation == Relation::none) continue;
        if (relation == Relation::ordered && !overtakes(occupation, {near.element, entry.begin, entry.end})) continue;
        found(entry, relation);
      }
    }
  }
  const ResourceUsers& users() const { return users_; }
  /// Number of conflicts of `occupation`; for a resource that holds several robots, each of its users counts.
  int count(int robot, const Occupation& occupation) const {
    int number = 0;
    conflicts_of(robot, occupation, [&](const auto&, Relation) { ++number; });
    if (instance_.resources().empty()) return number;
    for (const Use& use : uses(instance_, {&occupation, 1})) {
      users_.beside(robot, use, [&](int, Range) { ++number; });
    }
    return number;
  }

 private:
  struct Entry {
    std::int32_t robot;
    std::int32_t step;  // index into the robot's path
    Half begin, end;
    std::int32_t next;
  };

  void add_whole(int robot, std::span<const Occupation> occupations);

  const Instance& instance_;
  const Relations& relations_;
  Limits& limits_;
  std::vector<Occupation> within_;
  std::vector<std::int32_t> head_;  // by element, -1 = none
  std::vector<Entry> entries_;
  std::vector<std::int32_t> touched_;
  ResourceUsers users_;
  std::size_t counted_ = 0;
};

/// The reservations as one robot sees them.
class Others final : public Obstacles {
 public:
  Others(const Reservations& reservations, int robot) : reservations_(reservations), robot_(robot) {}
  void at_vertex(int vertex, std::vector<Range>& halves) const override {
    reservations_.at_vertex(robot_, vertex, halves);
  }
  void on_edge(int edge, Tick duration, std::vector<Range>& departures) const override {
    reservations_.on_edge(robot_, edge, duration, departures);
  }

 private:
  const Reservations& reservations_;
  int robot_;
};

/// Reserve what every robot does for certain (standing at its start at tick 0 alone binds no robot, unless robots may
/// be late).
void reserve_beginnings(const Instance& instance, Reservations& reservations);

}  // namespace mrpbench::mapf
