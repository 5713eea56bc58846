// Generalised rectangle reasoning: two robots that cross the same region, on many paths each, but always meet in it.
// Li, Harabor, Stuckey, Ma, Gange and Koenig, "Pairwise symmetry reasoning for multi-agent path finding search", AIJ
// 2021. There the meeting is proved by planar geometry; here by propagating which places exclude one another through
// the decision diagrams (Zhang, Li, Surynek, Koenig and Kumar, "Multi-agent path finding with mutex propagation", ICAPS
// 2020), so that any graph of unit moves will do.
#pragma once

#include "mrpbench_mapf/cbs/constraints/timed_path.hpp"
#include "mrpbench_mapf/cbs/low_level/mdd.hpp"

namespace mrpbench::mapf {

class Rectangles {
 public:
  explicit Rectangles(Limits& limits) : limits_(limits) {}

  /// For two robots that meet at `vertex` at `tick` in classical instances: sets of places and ticks, one for each,
  /// such that a robot that passes one of its own excludes that the other one does. Both contain a place of the
  /// present paths. Nothing if that says no more than the conflict itself, or if they do not meet on cheapest paths.
  bool resolve(const Mdd& one, const TimedPath& one_path, const Mdd& other, const TimedPath& other_path, int vertex,
               Tick tick);
  std::span<const Constraint> one_branch() const { return branch_[0]; }
  std::span<const Constraint> other_branch() const { return branch_[1]; }

 private:
  /// A vertex and tick in both diagrams, in the region around the conflict.
  struct Place {
    std::int32_t vertex;
    Tick tick;
    std::array<std::int32_t, 2> node;                      // in either diagram
    std::array<char, 2> exit = {false, false};             // can the robot leave the region from here?
    std::array<char, 2> entrance = {false, false};         // can it have come here from outside?
    std::array<std::vector<std::int32_t>, 2> before = {};  // places from which it may have come
  };
  using Mdds = std::array<const Mdd*, 2>;

  bool find_region(const Mdds& mdds, int vertex, Tick tick);
  void list_common(const Mdds& mdds, Tick tick);
  void connect(const Mdds& mdds, int side);
  void propagate();
  bool excluded(int one, int other) const;
  bool must_meet(const Place& one, const Place& other) const;
  void relate_exits();
  int exit_of(const TimedPath& path, int vertex, Tick tick) const;
  int find(int vertex, Tick tick) const;
  std::size_t select(int first_side, int first, std::array<std::vector<std::int32_t>, 2>& chosen) const;

  Limits& limits_;
  Tick begin_ = 0;                    // first tick of the region
  std::vector<Place> places_;         // by tick
  std::vector<std::int32_t> levels_;  // first place by tick
  /// For two places at the same tick, by level: no two paths without a conflict bring the robots there.
  std::vector<std::size_t> first_excluded_;
  std::vector<char> excluded_;
  std::array<std::vector<std::int32_t>, 2> exits_;  // places
  std::vector<char> exits_excluded_;                // exit of one * exits of other + exit of other
  std::array<std::vector<Constraint>, 2> branch_;
  std::vector<std::int32_t> group_, place_of_;
  std::vector<char> present_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
