#include "mrpbench_mapf/algorithms/cbs.hpp"

#include "mrpbench_mapf/cbs/tree/tree_search.hpp"

namespace mrpbench::mapf {

Result solve_cbs(const Instance& instance, const CbsOptions& options, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) {
    limits.check_clock();
    SearchContext context(instance, options, limits, result.statistics);
    if (const auto robot = prove_infeasible(context)) return result.no_plan_for(*robot);
    result.lower_bound = static_cast<double>(context.distances.sum_of_costs(instance));
    BestFirst open(limits);
    OptimalSearch low_level(context);
    search_tree(context, open, low_level, result);
  });
}

}  // namespace mrpbench::mapf
