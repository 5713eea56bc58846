#include "mrpbench_mapf/bounded/bounded_cbs.hpp"

#include "mrpbench_mapf/bounded/bounded_tree.hpp"

namespace mrpbench::mapf {

namespace {

void solve(const Instance& instance, const BoundedOptions& options, Limits& limits, Result& result) {
  limits.check_clock();
  result.lower_bound = 0.0;
  Workbench bench(instance, options.techniques, limits, result.statistics);
  if (const auto robot = find_hopeless(bench)) {
    result.statistics.failed_robot = *robot;
    result.status = Status::unsolvable;
    return;
  }
  BoundedTree(bench, options, result).solve();
}

}  // namespace

Result solve_bounded(const Instance& instance, const BoundedOptions& options, Limits& limits) {
  Result result;
  try {
    solve(instance, options, limits, result);
  } catch (const LimitReached& limit) {
    result.status = limit.status;
  } catch (const std::bad_alloc&) {
    result.status = Status::out_of_memory;
  }
  result.statistics.memory_bytes = limits.memory_used();
  return result;
}

}  // namespace mrpbench::mapf
