#include "mrpbench_mapf/bounded/bounded_cbs.hpp"

#include "mrpbench_mapf/bounded/bounded_tree.hpp"
#include "mrpbench_mapf/bounded/interval_space.hpp"
#include "mrpbench_mapf/bounded/unit_space.hpp"

namespace mrpbench::mapf {

namespace {

template <class Space, class... Roadmap>
void solve(const Instance& instance, const BoundedOptions& options, Limits& limits, Result& result,
           const Roadmap&... roadmap) {
  limits.check_clock();
  result.lower_bound = 0.0;
  Space space(instance, roadmap..., options, limits, result.statistics);
  if (const std::optional<int> robot = space.find_hopeless()) {
    result.statistics.failed_robot = *robot;
    result.status = Status::unsolvable;
  } else {
    BoundedTree<Space>(space, options, limits, result).solve();
  }
}

}  // namespace

Result solve_bounded(const Instance& instance, const BoundedOptions& options, Limits& limits) {
  Result result;
  try {
    if (const std::optional<UnitRoadmap> roadmap = unit_roadmap(instance)) {
      solve<UnitSpace>(instance, options, limits, result, *roadmap);
    } else {
      solve<IntervalSpace>(instance, options, limits, result);
    }
  } catch (const LimitReached& limit) {
    result.status = limit.status;
  } catch (const std::bad_alloc&) {
    result.status = Status::out_of_memory;
  }
  result.statistics.memory_bytes = limits.memory_used();
  return result;
}

}  // namespace mrpbench::mapf
