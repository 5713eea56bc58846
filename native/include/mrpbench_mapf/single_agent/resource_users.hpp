// Which robots use the resources of a roadmap, and when (rule 6 of `mrpbench_core.model.planning.conflicts`).
#pragma once

#include <span>
#include <vector>

#include "mrpbench_mapf/model/uses.hpp"

namespace mrpbench::mapf {

class ResourceUsers {
 public:
  explicit ResourceUsers(const Instance& instance);

  void add(int robot, std::span<const Occupation> path);
  /// Exactly what was added.
  void remove(int robot, std::span<const Occupation> path);
  void clear();
  /// Append the half-ticks in which `robot` must not be on any element of `resource`: with it there would be too many,
  /// then or, as it uses the resource for the setup after it has left, soon after.
  void full(int robot, int resource, std::vector<Range>& halves) const;
  /// Append the departures at which `robot` must not enter an edge that belongs to `resource`.
  void full_departures(int robot, int resource, Tick duration, std::vector<Range>& departures) const;
  /// Call `found(other, halves)` for every use by another robot that meets `use`.
  template <class Found>
  void beside(int robot, const Use& use, Found found) const {
    for (const User& it : users_[use.resource]) {
      if (it.robot == robot || it.halves.first > use.halves.last || it.halves.last < use.halves.first) continue;
      found(it.robot, it.halves);
    }
  }
  /// The robots, perhaps repeatedly, that with `robot` are among too many at some time of `use`.
  std::vector<int> too_many_with(int robot, const Use& use) const;

 private:
  struct User {
    std::int32_t robot;
    Range halves;  // setup included
  };

  const Instance& instance_;
  std::vector<std::vector<User>> users_;  // by resource
};

}  // namespace mrpbench::mapf
