// Which robots are where and when, by element of the roadmap and sorted by time, for paths that come and go often.
#pragma once

#include "mrpbench_mapf/model/conflict.hpp"
#include "mrpbench_mapf/single_agent/resource_users.hpp"

namespace mrpbench::mapf::lns {

struct Visit {
  Half begin, end;
  std::int32_t robot;
};

class Traffic {
 public:
  Traffic(const Instance& instance, const Relations& relations, Limits& limits);

  void add(int robot, std::span<const Occupation> path);
  /// Exactly what was added.
  void remove(int robot, std::span<const Occupation> path);
  /// In the order of `begin`.
  std::span<const Visit> at(int element) const { return visits_[element]; }
  const ResourceUsers& users() const { return users_; }

  /// Call `found(other)`, perhaps repeatedly, for every robot with which `occupation` of `robot` conflicts.
  template <class Found>
  void conflicts_of(int robot, const Occupation& occupation, Found found) const {
    if (unit_ && occupation.element >= vertex_count_) {
      const int edge = occupation.element - vertex_count_;
      swappers(instance_.roadmap().tail(edge), instance_.roadmap().head(edge), enter_tick(occupation), found);
      return;
    }
    const Range late = widened(occupation.begin, occupation.end, instance_.rules().k);
    for (const Near& near : relations_.row(occupation.element)) {
      for (const Visit& visit : visits_[near.element]) {
        if (visit.begin > late.last) break;
        if (visit.end < late.first || visit.robot == robot) continue;
        const Relation relation = near.relation(instance_.reach(robot, visit.robot));
        if (relation == Relation::none) continue;
        if (relation == Relation::ordered && !overtakes(occupation, {near.element, visit.begin, visit.end})) continue;
        found(visit.robot);
      }
    }
    if (instance_.resources().empty()) return;
    for (const Use& use : uses(instance_, {&occupation, 1})) {
      for (const int other : users_.too_many_with(robot, use)) found(other);
    }
  }
  /// On unit roadmaps: call `found(robot)` for all robots that go from `to` to `from` between `tick` and `tick + 1`.
  template <class Found>
  void swappers(int from, int to, Tick tick, Found found) const {
    for (const Visit& leaving : visits_[to]) {
      if (leaving.begin > 2 * tick) return;
      if (leaving.end != 2 * tick) continue;
      for (const Visit& coming : visits_[from]) {
        if (coming.begin == 2 * tick + 2 && coming.robot == leaving.robot) found(leaving.robot);
      }
    }
  }
  /// Every move takes one tick, and only robots at one vertex and swapping ones conflict: lanes are not listed then.
  bool is_unit() const { return unit_; }
  const Instance& instance() const { return instance_; }
  const Relations& relations() const { return relations_; }

 private:
  const Instance& instance_;
  const Relations& relations_;
  Limits& limits_;
  bool unit_;
  int vertex_count_;
  std::vector<std::vector<Visit>> visits_;
  ResourceUsers users_;
};

}  // namespace mrpbench::mapf::lns
