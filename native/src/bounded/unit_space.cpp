#include "mrpbench_mapf/bounded/unit_space.hpp"

#include "mrpbench_mapf/solvability.hpp"

namespace mrpbench::mapf {

UnitSpace::UnitSpace(const Instance& instance, const UnitRoadmap& roadmap, const BoundedOptions& options,
                     Limits& limits, Statistics& statistics)
    : instance_(instance),
      limits_(limits),
      options_(options),
      table_(roadmap.vertex_count(), instance.size(), limits),
      constraints_(roadmap.vertex_count(), limits),
      search_(roadmap, options, limits, statistics),
      corridors_(roadmap, search_, limits) {
  distance_.reserve(instance.size());
  for (int robot = 0; robot < robots(); ++robot) {
    limits.check_clock();
    limits.charge(UnitDistance::bytes(roadmap));
    distance_.emplace_back(roadmap, goal(robot), limits);
  }
}

std::optional<int> UnitSpace::find_hopeless() {
  for (int robot = 0; robot < robots(); ++robot) {
    if (distance_[robot](start(robot)) == kForever) return robot;
  }
  return find_shared_place(instance_, limits_);
}

std::optional<std::array<UnitConstraint, 2>> UnitSpace::at_target(const UnitConflict& conflict) const {
  if (conflict.from >= 0) return std::nullopt;
  for (const int robot : {conflict.one, conflict.other}) {
    if (goal(robot) == conflict.vertex && conflict.time >= cost(table_.path(robot))) {
      return split_at_target(conflict, robot);
    }
  }
  return std::nullopt;
}

}  // namespace mrpbench::mapf
