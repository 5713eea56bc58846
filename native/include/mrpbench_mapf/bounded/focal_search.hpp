// A path for one robot on a roadmap of unit moves that has few conflicts with the present paths of others and costs at
// most w times the least: the lower level of Barer, Sharon, Stern and Felner, "Suboptimal variants of the
// conflict-based search algorithm for the multi-agent pathfinding problem", SoCS 2014.
#pragma once

#include <vector>

#include "mrpbench_mapf/bounded/cost_bound.hpp"
#include "mrpbench_mapf/bounded/focal_queue.hpp"
#include "mrpbench_mapf/bounded/options.hpp"
#include "mrpbench_mapf/bounded/path_table.hpp"
#include "mrpbench_mapf/bounded/unit_constraints.hpp"
#include "mrpbench_mapf/bounded/unit_distance.hpp"
#include "mrpbench_mapf/result.hpp"

namespace mrpbench::mapf {

class FocalSearch {
 public:
  FocalSearch(const UnitRoadmap& roadmap, const BoundedOptions& options, Limits& limits, Statistics& statistics);

  /// Writes the steps from `start` to `goal`, and returns a lower bound on the cost of all paths that keep the
  /// constraints (at least `known`, which must be one), or kForever if there is none. `others` must not contain the
  /// robot itself.
  Tick search(int start, int goal, UnitDistance& distance, const UnitConstraints& constraints, const PathTable& others,
              const CostBound& bound, Tick known, std::vector<std::int32_t>& steps);

  /// A lower bound on the tick at which `vertex` can be visited under the constraints, those on arrival apart; kForever
  /// if never.
  Tick earliest_visit(int start, int vertex, UnitDistance& distance, const UnitConstraints& constraints);

 private:
  struct Node {
    std::int32_t vertex;  // vertex_count for the end of a path: standing at the goal from then on
    Tick tick;
    std::int32_t parent;  // -1: none
    std::int32_t conflicts;
    bool closed;
  };
  struct Found {
    Tick least;         // no path costs less, kForever if there is none
    std::int32_t node;  // the end of the path
  };
  Found run(int start, int goal, UnitDistance& distance, const UnitConstraints& constraints, const PathTable& others,
            const CostBound& bound);
  std::int32_t& slot(std::int32_t vertex, Tick tick);
  void grow();
  void relax(std::int32_t vertex, Tick tick, Tick f, Tick h, std::int32_t parent, std::int32_t conflicts);
  void arrive(Tick tick, std::int32_t parent, std::int32_t conflicts);
  void expand(std::int32_t node);
  /// Ticks from `vertex` to the goal for a robot that is there at `tick`; never more than the truth.
  Tick estimate(std::int32_t vertex, Tick tick) {
    return detours_ && tick >= constraints_->last_change() ? detour_[vertex] : (*distance_)(vertex);
  }
  void find_detours();
  void trace(std::int32_t node, std::vector<std::int32_t>& steps) const;
  int column(Tick f, Tick h, std::int32_t conflicts) const;

  const UnitRoadmap& roadmap_;
  const BoundedOptions& options_;
  Limits& limits_;
  Statistics& statistics_;
  const PathTable nobody_;
  // the current search
  UnitDistance* distance_ = nullptr;
  const UnitConstraints* constraints_ = nullptr;
  const PathTable* others_ = nullptr;
  int goal_ = 0;
  Tick least_ = 0;      // no path costs less
  Tick free_from_ = 0;  // from when on the goal is free
  Tick latest_ = 0;     // no path may cost more
  Tick last_tick_ = 0;  // a robot that has any path has one that ends by then
  std::vector<Node> nodes_;
  std::vector<std::int32_t> table_;    // by hash of vertex and tick: node + 1, 0 = none
  std::vector<std::int32_t> passing_;  // by tick: conflicts at the goal after it
  bool detours_ = false;
  std::vector<Tick> detour_;  // distances to the goal around vertices that are closed for ever
  std::vector<std::int32_t> breadth_;
  FocalQueue queue_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
