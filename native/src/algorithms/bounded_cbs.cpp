#include "mrpbench_mapf/algorithms/bounded_cbs.hpp"

#include <algorithm>

#include "algorithms/anytime_fallback.hpp"
#include "mrpbench_mapf/cbs/low_level/focal_search.hpp"
#include "mrpbench_mapf/cbs/tree/focal_list.hpp"
#include "mrpbench_mapf/cbs/tree/tree_search.hpp"

namespace mrpbench::mapf {

namespace {

/// A path within the bound that has few conflicts, by `FocalSearch`.
class BoundedSearch final : public LowLevel {
 public:
  BoundedSearch(SearchContext& context, const BoundedOptions& options)
      : context_(context),
        options_(options),
        search_(context.space, context.intervals, options, context.limits, context.statistics) {}

  Tick plan(const NodeState& state, int robot, int goal, std::span<const Constraint> more,
            const AvoidanceTable& present, Tick known, const Sums& others, FoundPath& path) override {
    CostBound bound{options_.w};
    if (options_.flex) bound = {options_.w, others.least, others.cost};
    state.load(robot, goal, context_.table);
    context_.table.add(more);
    DistanceTable& distance = context_.distance_to_goal(robot, goal);
    if (!context_.soft_intervals) {
      return search_.search(context_.table, distance, present, bound, known, path);
    }
    const Tick least = context_.intervals.least_cost(context_.table, distance);
    if (least == kForever) return kForever;
    const Tick latest = std::min(std::max(bound(least), least), context_.table.latest_finish());
    const bool found = context_.soft_intervals->search(context_.table, distance, &present, latest, path);
    return found ? std::max(known, least) : kForever;
  }
  bool is_optimal() const override { return false; }
  /// Where moves take many ticks the paths must not cost more: dear detours would use the bound up long before the last
  /// conflict is gone. Another assignment has another lower bound.
  bool allows_bypass(const NodeState& state, const Sums& node, const Sums& child,
                     std::span<const RobotPlan> plans) const override {
    if (static_cast<double>(child.cost) > options_.w * static_cast<double>(node.least)) return false;
    if (!context_.space.classical() && child.cost > node.cost) return false;
    return std::ranges::all_of(plans, [&](const RobotPlan& it) {
      const bool within = options_.flex || it.path.cost <= CostBound{options_.w}(state.least(it.robot));
      return within && it.path.goal == state.path(it.robot).goal;
    });
  }

 private:
  SearchContext& context_;
  const BoundedOptions& options_;
  FocalSearch search_;
};

}  // namespace

Result solve_bounded(const Instance& instance, const BoundedOptions& options, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) {
    limits.check_clock();
    result.lower_bound = 0.0;
    SearchContext context(instance, options.techniques, limits, result.statistics);
    if (const auto robot = prove_infeasible(context)) return result.no_plan_for(*robot);
    FocalList open(options.selection, options.w, limits);
    BoundedSearch low_level(context, options);
    AnytimeFallback fallback(context, options, result);
    search_tree(context, open, low_level, result, [&] { return fallback.solve(); });
  });
}

}  // namespace mrpbench::mapf
