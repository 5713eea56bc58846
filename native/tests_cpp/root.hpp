// The first node of a constraint tree.
#pragma once

#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/cbs/reasoning.hpp"

namespace mrpbench::mapf {

/// Cheapest paths of all robots, and the conflicts of the first two.
struct Root {
  explicit Root(Instance given, CbsOptions options = {})
      : instance(std::move(given)),
        bench(instance, options, limits, statistics),
        situation(instance.size()),
        constraints(limits),
        paths(true, limits),
        reasoning(bench, constraints) {
    for (int robot = 0; robot < instance.size(); ++robot) {
      FoundPath path;
      CHECK(bench.plan(situation, robot, TimedPath::kAnyGoal, {}, nullptr, path));
      situation.set_path(robot, paths.keep(path));
    }
    AvoidanceTable present(bench.space, limits);
    present.add(1, situation.path(1));
    present.refresh();
    find_conflicts(bench.space, present, 0, situation.path(0), constraints, conflicts);
    for (Conflict& conflict : conflicts) reasoning.examine(situation, conflict);
  }

  Instance instance;
  Limits limits = unlimited();
  Statistics statistics;
  Workbench bench;
  Situation situation;
  Arena<Constraint> constraints;
  PathStore paths;
  Reasoning reasoning;
  std::vector<Conflict> conflicts;
};

}  // namespace mrpbench::mapf
