// Corridor reasoning: two robots that pass a chain of vertices in opposite directions. One of them has to wait until
// the other has left the chain, or to go round. Li, Harabor, Stuckey, Ma, Gange and Koenig, "Pairwise symmetry
// reasoning for multi-agent path finding search", AIJ 2021; a single lane is their pseudo-corridor. Robots may begin or
// end inside the chain.
#pragma once

#include "mrpbench_mapf/cbs/constraints/conflict.hpp"
#include "mrpbench_mapf/cbs/low_level/search_context.hpp"

namespace mrpbench::mapf {

class Corridors {
 public:
  explicit Corridors(SearchContext& context) : context_(context) {}

  /// Branches of `conflict`: each robot has to come to its end of the corridor later. Single lanes only if
  /// `pseudo`. Nothing if the robots do not meet in a corridor, or if the branches would not end what they do now.
  std::optional<std::array<Constraint, 2>> resolve(const NodeState& state, const Conflict& conflict, bool pseudo);

  struct AtTarget {
    Constraint ending;
    std::array<Constraint, 2> passing;
  };
  /// The same where the corridor leads over the end of `ending`: either that robot comes there once `passing` has left
  /// the corridor, or it is there sooner and `passing` has to go round.
  std::optional<AtTarget> resolve_at_target(const NodeState& state, const Conflict& conflict, int passing, int ending);

 private:
  struct Stop {
    std::int32_t vertex;
    Tick arrive;
  };
  void list_stops(const TimedPath& path, std::vector<Stop>& stops) const;
  bool find_lane(const Conflict& conflict);
  bool find_passage(const Conflict& conflict, int target);
  template <class IsEnd>
  void extend(IsEnd is_end);
  bool is_under_way(int robot) const;
  bool opposed(int one, int other) const;
  int next(int vertex, int from) const;
  Tick length(int robot, std::size_t from, std::size_t to) const;
  Tick earliest(const NodeState& state, int robot, int vertex, Tick latest);
  Tick bound(const NodeState& state, int robot, int before_exit, int exit, Tick latest);
  Tick arrival_at(std::span<const Stop> stops, int vertex) const;

  SearchContext& context_;
  std::vector<Stop> one_stops_, other_stops_;
  std::vector<std::int32_t> chain_;  // vertices in the direction of `one`
};

}  // namespace mrpbench::mapf
