#include "mrpbench_mapf/bounded/bounded_cbs.hpp"

#include "mrpbench_mapf/bounded/bounded_tree.hpp"

namespace mrpbench::mapf {

namespace {

void solve(const Instance& instance, const BoundedOptions& options, Limits& limits, Result& result) {
  limits.check_clock();
  result.lower_bound = 0.0;
  Workbench bench(instance, options.techniques, limits, result.statistics);
  if (const auto robot = find_hopeless(bench)) return result.no_plan_for(*robot);
  BoundedTree(bench, options, result).solve();
}

}  // namespace

Result solve_bounded(const Instance& instance, const BoundedOptions& options, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) { solve(instance, options, limits, result); });
}

}  // namespace mrpbench::mapf
