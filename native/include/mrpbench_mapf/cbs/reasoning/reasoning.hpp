// How a conflict is best resolved: by what branches, and how many of them cost more.
#pragma once

#include "mrpbench_mapf/cbs/reasoning/corridor.hpp"
#include "mrpbench_mapf/cbs/reasoning/precedence.hpp"
#include "mrpbench_mapf/cbs/reasoning/rectangle.hpp"
#include "mrpbench_mapf/cbs/reasoning/target.hpp"

namespace mrpbench::mapf {

class Reasoning {
 public:
  /// The constraints of branches are kept in `constraints`.
  Reasoning(SearchContext& context, Arena<Constraint>& constraints)
      : context_(context),
        constraints_(constraints),
        corridors_(context),
        rectangles_(context.limits),
        precedence_(context) {}

  /// Fill in what `conflict` says about its resolution, unless that was done before.
  void examine(const NodeState& state, Conflict& conflict);

 private:
  bool examine_target(const NodeState& state, Conflict& conflict);
  bool examine_passing(const NodeState& state, Conflict& conflict);
  void examine_junction(const NodeState& state, Conflict& conflict);
  Half earliest_done(const NodeState& state, const Conflict& conflict, int robot, int junction);
  bool examine_corridor(const NodeState& state, Conflict& conflict);
  bool examine_corridor_to(const NodeState& state, Conflict& conflict, int passing, int ending);
  void examine_rectangle(const NodeState& state, Conflict& conflict);
  void examine_precedence(const NodeState& state, Conflict& conflict);
  void rate(const NodeState& state, Conflict& conflict);
  void use(Conflict& conflict, Conflict::Kind kind, std::span<const Constraint> one, std::span<const Constraint> other);
  void use(Conflict& conflict, Conflict::Kind kind, const std::array<Constraint, 2>& branches) {
    use(conflict, kind, std::span(&branches[0], 1), std::span(&branches[1], 1));
  }

  SearchContext& context_;
  Arena<Constraint>& constraints_;
  Corridors corridors_;
  Rectangles rectangles_;
  Precedence precedence_;
};

}  // namespace mrpbench::mapf
