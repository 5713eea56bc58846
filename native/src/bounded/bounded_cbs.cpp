#include "mrpbench_mapf/bounded/bounded_cbs.hpp"

#include <algorithm>

#include "mrpbench_mapf/bounded/anytime_fallback.hpp"
#include "mrpbench_mapf/bounded/focal_list.hpp"
#include "mrpbench_mapf/bounded/focal_search.hpp"
#include "mrpbench_mapf/cbs/tree_search.hpp"

namespace mrpbench::mapf {

namespace {

/// A path within the bound that has few conflicts, by `FocalSearch`.
class BoundedSearch final : public LowLevel {
 public:
  BoundedSearch(Workbench& bench, const BoundedOptions& options)
      : bench_(bench),
        options_(options),
        search_(bench.space, bench.intervals, options, bench.limits, bench.statistics) {}

  Tick plan(const Situation& situation, int robot, int goal, std::span<const Constraint> more,
            const AvoidanceTable& present, Tick known, const Sums& others, FoundPath& path) override {
    CostBound bound{options_.w};
    if (options_.flex) bound = {options_.w, others.least, others.cost};
    situation.load(robot, goal, bench_.table);
    bench_.table.add(more);
    return search_.search(bench_.table, bench_.distance_to_goal(robot, goal), present, bound, known, path);
  }
  bool is_optimal() const override { return false; }
  /// Where moves take many ticks the paths must not cost more: dear detours would use the bound up long before the last
  /// conflict is gone. Another assignment has another lower bound.
  bool allows_bypass(const Situation& situation, const Sums& node, const Sums& child,
                     std::span<const RobotPlan> plans) const override {
    if (static_cast<double>(child.cost) > options_.w * static_cast<double>(node.least)) return false;
    if (!bench_.space.textbook() && child.cost > node.cost) return false;
    return std::ranges::all_of(plans, [&](const RobotPlan& it) {
      const bool within = options_.flex || it.path.cost <= CostBound{options_.w}(situation.least(it.robot));
      return within && it.path.goal == situation.path(it.robot).goal;
    });
  }

 private:
  Workbench& bench_;
  const BoundedOptions& options_;
  FocalSearch search_;
};

}  // namespace

Result solve_bounded(const Instance& instance, const BoundedOptions& options, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) {
    limits.check_clock();
    result.lower_bound = 0.0;
    Workbench bench(instance, options.techniques, limits, result.statistics);
    if (const auto robot = find_hopeless(bench)) return result.no_plan_for(*robot);
    FocalList open(options.selection, options.w, limits);
    BoundedSearch low_level(bench, options);
    AnytimeFallback fallback(bench, options, result);
    search_tree(bench, open, low_level, result, [&] { return fallback.solve(); });
  });
}

}  // namespace mrpbench::mapf
