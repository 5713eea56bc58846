#include "mrpbench_mapf/cbs.hpp"

#include "mrpbench_mapf/cbs/tree_search.hpp"

namespace mrpbench::mapf {

Result solve_cbs(const Instance& instance, const CbsOptions& options, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) {
    limits.check_clock();
    Workbench bench(instance, options, limits, result.statistics);
    if (const auto robot = find_hopeless(bench)) return result.no_plan_for(*robot);
    result.lower_bound = static_cast<double>(bench.distances.sum_of_costs(instance));
    BestFirst open(limits);
    OptimalSearch low_level(bench);
    search_tree(bench, open, low_level, result);
  });
}

}  // namespace mrpbench::mapf
