#include "mrpbench_mapf/cbs.hpp"

#include <limits>

#include "mrpbench_mapf/cbs/dependencies.hpp"

namespace mrpbench::mapf {

namespace {

void solve(const Instance& instance, const CbsOptions& options, Limits& limits, Result& result) {
  limits.check_clock();
  Workbench bench(instance, options, limits, result.statistics);
  if (const auto robot = find_hopeless(bench)) return result.no_plan_for(*robot);
  result.lower_bound = static_cast<double>(bench.distances.sum_of_costs(instance));
  std::optional<Dependencies> dependencies;
  if (options.heuristic && options.goals != GoalChoice::by_node) dependencies.emplace(bench);
  ConstraintTree tree(bench, dependencies ? &*dependencies : nullptr);
  std::optional<RankedGoals> ranked;
  std::optional<NodeAssignment> assignment;
  if (options.goals == GoalChoice::own) {
    if (const auto robot = tree.start()) return result.no_plan_for(*robot);
  } else if (options.goals == GoalChoice::ranked) {
    tree.start(ranked.emplace(find_candidates(bench), limits));
  } else if (!tree.start(assignment.emplace(find_candidates(bench), limits))) {
    return result.no_plan_for(-1);
  }
  bool solved = false;
  search_within_limits(result, [&] {
    solved = tree.run(std::numeric_limits<std::int64_t>::max()) == ConstraintTree::Outcome::solved;
    if (!solved) result.status = Status::unsolvable;
  });
  result.lower_bound = static_cast<double>(tree.lower_bound());
  result.statistics.expansions = tree.counts().expansions;
  result.statistics.generated = tree.counts().generated;
  result.statistics.bypasses = tree.counts().bypasses;
  if (ranked) result.statistics.assignments = tree.counts().roots;
  if (assignment) result.statistics.assignments = 1 + assignment->changes();
  if (dependencies) result.statistics.pair_expansions = dependencies->counts().expansions;
  if (!solved) return;
  for (int robot = 0; robot < instance.size(); ++robot) {
    result.paths.push_back(occupations(bench.space, robot, tree.situation().path(robot)));
  }
  result.status = Status::solved;
}

}  // namespace

Result solve_cbs(const Instance& instance, const CbsOptions& options, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) { solve(instance, options, limits, result); });
}

}  // namespace mrpbench::mapf
