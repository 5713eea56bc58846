#include "mrpbench_mapf/algorithms/cbs.hpp"

#include "algorithms/anytime_fallback.hpp"
#include "mrpbench_mapf/cbs/tree/dependencies.hpp"
#include "mrpbench_mapf/cbs/tree/focal_list.hpp"

namespace mrpbench::mapf {

namespace {

Status search(ConstraintTree& tree, const Space& space, AnytimeFallback& fallback, Result& result) {
  while (tree.next()) {
    result.lower_bound = static_cast<double>(tree.lower_bound());
    if (tree.is_solved()) {
      for (int robot = 0; robot < space.instance().size(); ++robot) {
        result.paths.push_back(occupations(space, robot, tree.state().path(robot)));
      }
      return Status::solved;
    }
    if (fallback.solve()) return Status::solved;
    tree.expand();
  }
  return Status::unsolvable;
}

std::unique_ptr<OpenList> make_open_list(const CbsOptions& options, Limits& limits) {
  if (options.selection == Selection::best_first) return std::make_unique<BestFirst>(limits);
  return std::make_unique<FocalList>(options.selection, options.w, limits);
}

}  // namespace

Result solve_cbs(const Instance& instance, const CbsOptions& options, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) {
    limits.check_clock();
    SearchContext context(instance, options, limits, result.statistics);
    if (const auto robot = prove_infeasible(context)) return result.no_plan_for(*robot);
    result.lower_bound = static_cast<double>(context.distances.sum_of_costs(instance));
    const auto open = make_open_list(options, limits);
    std::optional<Dependencies> dependencies;
    if (options.heuristic && options.goals != GoalChoice::by_node) dependencies.emplace(context);
    ConstraintTree tree(context, *open, options, dependencies ? &*dependencies : nullptr);
    AnytimeFallback fallback(context, result);
    if (!tree.start()) return result.no_plan_for(tree.failed_robot());
    search_within_limits(result, [&] { result.status = search(tree, context.space, fallback, result); });
    result.lower_bound = static_cast<double>(tree.lower_bound());
    result.statistics.expansions = tree.counts().expanded;
    result.statistics.generated = tree.counts().generated;
    result.statistics.bypasses = tree.counts().bypasses;
    result.statistics.assignments = tree.assignments();
    if (dependencies) result.statistics.pair_expansions = dependencies->expansions();
  });
}

}  // namespace mrpbench::mapf
