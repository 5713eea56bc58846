// Roadmaps on which every move takes one tick, as grids are: a path is one vertex per tick, and a conflict is two
// robots at one vertex or swapping two. On these the searches for bounded plans run several times faster than on
// intervals.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mrpbench_mapf/instance.hpp"

namespace mrpbench::mapf {

/// One vertex per tick, from tick 0 to the arrival; the robot stands at the last one for ever.
using Steps = std::span<const std::int32_t>;

class UnitRoadmap {
 public:
  UnitRoadmap(const Roadmap& roadmap, int profile);

  int vertex_count() const { return static_cast<int>(out_first_.size()) - 1; }
  std::span<const std::int32_t> successors(int vertex) const { return row(out_first_, head_, vertex); }
  std::span<const std::int32_t> predecessors(int vertex) const { return row(in_first_, tail_, vertex); }

 private:
  static std::span<const std::int32_t> row(const std::vector<std::int32_t>& first,
                                           const std::vector<std::int32_t>& item, int vertex) {
    return {item.data() + first[vertex], item.data() + first[vertex + 1]};
  }

  std::vector<std::int32_t> out_first_, head_, in_first_, tail_;
};

inline constexpr int kMostRobots = 65'000;  // path tables hold robots in 16 bits

/// The roadmap of an instance that is plain: unit durations, one motion profile, one goal each where robots stay, no
/// footprints, no commitments, all ready at tick 0, following allowed. Nothing for any other.
std::optional<UnitRoadmap> unit_roadmap(const Instance& instance);

/// The path of `robot` as occupations.
std::vector<Occupation> occupations(const Instance& instance, int robot, Steps steps);

}  // namespace mrpbench::mapf
