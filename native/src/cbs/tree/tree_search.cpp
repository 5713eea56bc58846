#include "mrpbench_mapf/cbs/tree/tree_search.hpp"

#include <limits>

#include "mrpbench_mapf/cbs/tree/dependencies.hpp"

namespace mrpbench::mapf {

namespace {

Status search(ConstraintTree& tree, const Space& space, Result& result, const std::function<bool()>& solved_otherwise) {
  while (tree.next()) {
    result.lower_bound = static_cast<double>(tree.lower_bound());
    if (tree.is_solved()) {
      for (int robot = 0; robot < space.instance().size(); ++robot) {
        result.paths.push_back(occupations(space, robot, tree.state().path(robot)));
      }
      return Status::solved;
    }
    if (solved_otherwise()) return Status::solved;
    tree.expand(std::numeric_limits<std::int64_t>::max());
  }
  return Status::unsolvable;
}

}  // namespace

void search_tree(SearchContext& context, OpenList& open, LowLevel& low_level, Result& result,
                 const std::function<bool()>& solved_otherwise) {
  std::optional<Dependencies> dependencies;
  if (context.options.heuristic && context.options.goals != GoalChoice::by_node) dependencies.emplace(context);
  ConstraintTree tree(context, open, low_level, dependencies ? &*dependencies : nullptr);
  if (!tree.start()) return result.no_plan_for(tree.failed_robot());
  search_within_limits(result, [&] { result.status = search(tree, context.space, result, solved_otherwise); });
  result.lower_bound = static_cast<double>(tree.lower_bound());
  // Where paths are the cheapest, a bypass counts as an expansion, and a child that it makes needless as generated.
  const TreeCounts& counts = tree.counts();
  result.statistics.expansions = low_level.is_optimal() ? counts.resolved : counts.expanded;
  result.statistics.generated = low_level.is_optimal() ? counts.planned : counts.generated;
  result.statistics.bypasses = counts.bypasses;
  result.statistics.assignments = tree.assignments();
  if (dependencies) result.statistics.pair_expansions = dependencies->expansions();
}

}  // namespace mrpbench::mapf
