// Safe interval path planning with soft constraints under the constraints of a node: the path with the fewest conflicts
// with other robots among those that cost at most a given number of ticks. A state is a vertex with an interval in
// which no constraint forbids it and the same robots are in the way, so that long waits cost nothing to search.
// Li, Chen, Harabor, Stuckey and Koenig, "MAPF-LNS2: Fast repairing for multi-agent path finding via large neighborhood
// search", AAAI 2022.
#pragma once

#include "mrpbench_mapf/cbs/constraints/avoidance_table.hpp"
#include "mrpbench_mapf/cbs/constraints/constraint_table.hpp"
#include "mrpbench_mapf/common/lazy_rows.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf {

class SoftIntervals {
 public:
  SoftIntervals(const Space& space, Limits& limits, Statistics& statistics);

  /// Find a path of the robot that `table` was reset for that costs at most `latest`; false if there is none.
  /// `distance` leads to its goals. Of `others`, if any, it avoids as many as it can. Not for classical instances.
  bool search(const ConstraintTable& table, DistanceTable& distance, const AvoidanceTable* others, Tick latest,
              FoundPath& path);

 private:
  struct State {
    Tick first, last;  // the interval
    Tick free_until;   // end of the interval in which no constraint forbids the vertex
    std::int32_t vertex;
    std::int32_t present;  // conflicts of a robot that comes in the interval
    std::int32_t begun;    // of these, those that one who has waited since the interval before does not have yet
    Tick closed;           // earliest arrival of a label that was expanded
  };
  struct Label {
    Tick arrival;
    std::int32_t conflicts;
    std::int32_t state;
    std::int32_t parent;  // label, -1 = none
    std::int32_t edge;    // by which it was reached, -1 = by waiting
    Tick cost;            // of the path that ends here, -1 = it goes on
  };
  struct Open {
    std::int32_t conflicts;
    Tick f, h;
    std::int32_t label;
    bool operator>(const Open& other) const {
      return std::tuple(conflicts, f, h, label) > std::tuple(other.conflicts, other.f, other.h, other.label);
    }
  };

  LazyRows<State>::Row states_of(int vertex);
  void add_shared(int vertex, Half free, Half blocked, std::vector<State>& states);
  std::span<const Range> departures_of(const Move& move);
  void expand(std::int32_t label);
  void follow(std::int32_t label, const Move& move, std::int32_t to);
  void finish(std::int32_t label);
  void reach(std::int32_t parent, std::int32_t to, std::int32_t edge, Tick arrival, std::int32_t conflicts);
  void push(const Label& label, Tick f, Tick h);
  void trace(std::int32_t label, FoundPath& path);

  const Space& space_;
  Limits& limits_;
  Statistics& statistics_;
  // the current search
  const ConstraintTable* table_ = nullptr;
  DistanceTable* distance_ = nullptr;
  const AvoidanceTable* others_ = nullptr;
  Tick latest_ = kForever;
  LazyRows<State> states_;      // by vertex
  LazyRows<Range> departures_;  // in conflict with others, by edge
  std::vector<Label> labels_;
  std::vector<Open> open_;
  std::vector<Range> blocked_, visits_;
  std::vector<Half> ends_;
  std::vector<Stop> stops_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
