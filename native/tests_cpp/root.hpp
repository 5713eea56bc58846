// The first node of a constraint tree.
#pragma once

#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/cbs/reasoning/reasoning.hpp"

namespace mrpbench::mapf {

/// Cheapest paths of all robots, and the conflicts of the first two.
struct Root {
  explicit Root(Instance given, CbsOptions options = {})
      : instance(std::move(given)),
        context(instance, options, limits, statistics),
        state(instance.size()),
        constraints(limits),
        paths(true, limits),
        reasoning(context, constraints) {
    const AvoidanceTable none(context.space, limits);
    for (int robot = 0; robot < instance.size(); ++robot) {
      FoundPath path;
      state.load(robot, TimedPath::kAnyGoal, context.table);
      CHECK(context.search.search(context.table, context.distances[robot], none, {}, {}, 0, path) < kForever);
      state.set_path(robot, paths.keep(path));
    }
    AvoidanceTable present(context.space, limits);
    present.add(1, state.path(1));
    present.refresh();
    find_conflicts(context.space, present, 0, state.path(0), constraints, conflicts);
    for (Conflict& conflict : conflicts) reasoning.examine(state, conflict);
  }

  Instance instance;
  Limits limits = unlimited();
  Statistics statistics;
  SearchContext context;
  NodeState state;
  Arena<Constraint> constraints;
  PathStore paths;
  Reasoning reasoning;
  std::vector<Conflict> conflicts;
};

}  // namespace mrpbench::mapf
