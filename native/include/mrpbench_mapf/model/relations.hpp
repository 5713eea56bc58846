// Which elements of the roadmap exclude one another, by the rules of `mrpbench_core.model.planning.conflicts`:
//   1 vertex, 2 swap, 4 following (optional), 5 footprint (optional): not at the same time;
//   3 overtaking: on one lane at the same time only in the order of entry.
// Definitions: Stern et al., "Multi-Agent Pathfinding: Definitions, Variants, and Benchmarks", SoCS 2019; footprints as
// in Li et al., "Multi-Agent Path Finding for Large Agents", AAAI 2019.
#pragma once

#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/instance.hpp"

namespace mrpbench::mapf {

enum class Relation { none, ordered, exclusive };

/// Element `element` excludes robots whose reach is greater than `distance`; otherwise it may still be the same lane.
struct Near {
  std::int32_t element;
  bool same_lane;
  double distance;  // metres; -1: always exclusive

  Relation relation(double reach) const {
    if (distance < reach) return Relation::exclusive;
    return same_lane ? Relation::ordered : Relation::none;
  }
};

class Relations {
 public:
  Relations(const Instance& instance, Limits& limits);

  /// Elements related to `element`, sorted; with itself where it is related to itself.
  std::span<const Near> row(int element) const {
    return {near_.data() + first_[element], near_.data() + first_[element + 1]};
  }
  Relation between(int one, int other, double reach) const {
    // On most roadmaps only a vertex with itself and the lanes of one pair of vertices are related: one comparison.
    return local_ && place_[one] != place_[other] ? Relation::none : find(one, other, reach);
  }

 private:
  Relation find(int one, int other, double reach) const;
  void add_lane_rules(const Instance& instance, int edge, std::vector<Near>& row) const;

  bool local_;                       // related elements have the same place
  std::vector<std::int32_t> place_;  // the vertex itself, or the first edge between the same two vertices
  std::vector<std::size_t> first_;
  std::vector<Near> near_;
};

}  // namespace mrpbench::mapf
