// How robots use the resources of a roadmap: doors, lifts and mutexes, each while a robot is on one of its elements and
// for the setup afterwards (rule 6 of `mrpbench_core.model.planning.conflicts`).
#pragma once

#include <span>
#include <vector>

#include "mrpbench_mapf/model/instance.hpp"

namespace mrpbench::mapf {

struct Use {
  std::int32_t resource;
  Range halves;  // setup included
};

/// What a path uses; uses of one resource do not touch one another.
std::vector<Use> uses(const Instance& instance, std::span<const Occupation> path);

/// Two of more robots than a resource holds.
struct CapacityConflict {
  std::int32_t one, other;  // robots
  Half time;                // half-tick at which there are too many
};

/// All pairs of robots that are among too many at some time.
std::vector<CapacityConflict> find_capacity_conflicts(const Instance& instance,
                                                      std::span<const std::span<const Occupation>> paths);

}  // namespace mrpbench::mapf
