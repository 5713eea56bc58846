// Target reasoning: a robot that stands at its goal is passed by another one. Either it arrives there later, or no
// robot uses the place from then on. Li, Harabor, Stuckey, Ma, Gange and Koenig, "Pairwise symmetry reasoning for
// multi-agent path finding search", AIJ 2021; here for any durations and footprints.
#pragma once

#include "mrpbench_mapf/cbs/constraints/conflict.hpp"
#include "mrpbench_mapf/cbs/constraints/node_state.hpp"

namespace mrpbench::mapf {

/// Branches of a conflict with `parked`, which has arrived for good, and `passing`: `parked` finishes later, or by
/// then. Nothing if the other one stays in the way for good.
std::optional<std::array<Constraint, 2>> resolve_at_target(const Space& space, const NodeState& state,
                                                           const Conflict& conflict, int parked, int passing);

/// Branches of a conflict of two robots that have both arrived for good: the one or the other never finishes there.
std::array<Constraint, 2> resolve_at_targets(const NodeState& state, const Conflict& conflict);

}  // namespace mrpbench::mapf
