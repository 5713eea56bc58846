// Two robots that meet head-on in a corridor, a chain of vertices with two neighbours each: one of them has to let the
// other leave the corridor first. Constraints that merely delay a robot by a tick would have to be stacked as high as
// the corridor is long. Li, Harabor, Stuckey, Ma, Gange and Koenig, "Pairwise symmetry reasoning for multi-agent path
// finding search", AIJ 2021, section on corridors.
#pragma once

#include <array>
#include <optional>
#include <unordered_map>

#include "mrpbench_mapf/bounded/focal_search.hpp"
#include "mrpbench_mapf/bounded/unit_conflict.hpp"

namespace mrpbench::mapf {

class UnitCorridors {
 public:
  /// A corridor through which `one` goes from front to back, and `other` from back to front.
  struct Meeting {
    int one, other;
    std::vector<std::int32_t> chain;  // with both ends, which are no part of the corridor themselves
    Tick one_leaves, other_leaves;    // when each is at its far end
  };
  /// How early a robot can be at the far end of a corridor, through it and around it. Lower bounds.
  struct Passage {
    Tick through, around;
  };

  UnitCorridors(const UnitRoadmap& roadmap, FocalSearch& search, Limits& limits);

  /// `stops` are vertices at which corridors end in any case: the starts and goals of the two robots.
  std::optional<Meeting> find(const UnitConflict& conflict, const PathTable& table,
                              const std::array<int, 4>& stops) const;
  /// For a robot that goes from the front of `chain` to its back. `constraints` are those of the robot, and are
  /// changed.
  Passage passage(std::span<const std::int32_t> chain, int start, UnitConstraints& constraints);
  /// Nothing if the constraints would not bind the present paths.
  static std::optional<std::array<UnitConstraint, 2>> split(const Meeting& meeting, const Passage& one,
                                                            const Passage& other);

 private:
  using Key = std::int64_t;
  bool follow(std::vector<std::int32_t>& chain, const std::array<int, 4>& stops) const;
  UnitDistance& distance_to(int vertex, int closed);

  const UnitRoadmap& roadmap_;
  FocalSearch& search_;
  Limits& limits_;
  std::vector<bool> inside_;  // by vertex: has two neighbours, with lanes both ways
  std::unordered_map<Key, UnitDistance> distances_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
