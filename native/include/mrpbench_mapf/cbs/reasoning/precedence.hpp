// Precedence at resources: of two robots that use a door, lift or mutex, one leaves it before the other one enters it.
// The branches are the two directions of a disjunctive arc of job-shop scheduling: Carlier and Pinson, "An algorithm
// for solving the job-shop problem", Management Science 35, 1989; a constraint forbids a range of ticks, as those of
// corridors do (Li et al., AIJ 2021).
#pragma once

#include "mrpbench_mapf/cbs/constraints/conflict.hpp"
#include "mrpbench_mapf/cbs/low_level/search_context.hpp"

namespace mrpbench::mapf {

class Precedence {
 public:
  explicit Precedence(SearchContext& context) : context_(context) {}

  /// Branches of `conflict` in a resource: each robot enters it only after the other one could have left it. Nothing if
  /// the present paths do not break both.
  std::optional<std::array<Constraint, 2>> resolve(const NodeState& state, const Conflict& conflict);

 private:
  struct Exits {
    std::vector<char> inside;                 // by element
    std::unique_ptr<DistanceTable> distance;  // to vertices from which a robot leaves
  };
  bool may_pass(int robot, int resource) const;
  Half earliest_left(const NodeState& state, int robot, int resource);
  bool enters_by(const NodeState& state, int robot, int resource, Half last) const;
  Exits& exits(int robot, int resource);

  SearchContext& context_;
  std::unordered_map<std::int64_t, Exits> exits_;  // by profile and resource
};

}  // namespace mrpbench::mapf
