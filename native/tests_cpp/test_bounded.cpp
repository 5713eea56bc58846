// Bounded-suboptimal conflict-based search against the optimal one, with every mixture of techniques.
#include <cmath>

#include "check.hpp"
#include "mrpbench_mapf/algorithms/cbs.hpp"
#include "plans.hpp"

using namespace mrpbench::mapf;

namespace {

CbsOptions draw(Random& random) {
  CbsOptions options;
  const auto toss = [&] { return random.below(2) == 0; };
  options.w = std::array{1.0, 1.02, 1.1, 1.5, 4.0}[random.below(5)];
  options.selection =
      std::array{Selection::best_first, Selection::focal, Selection::explicit_estimation}[random.below(3)];
  options.prioritize = toss();
  options.bypass = toss();
  options.heuristic = toss();
  options.target = toss();
  options.corridor = toss();
  options.rectangle = toss();
  options.flex = toss();
  options.incumbent_after = toss() ? std::nullopt : std::optional(static_cast<std::int64_t>(toss() ? 0 : 200));
  options.order.distance_weight = toss() ? 1.0 : 1.5;
  options.order.conflict_weight = toss() ? 0.0 : 5.0;
  return options;
}

std::int64_t expansions(const Instance& it, double w, CbsOptions options) {
  options.w = w;
  options.selection = Selection::explicit_estimation;
  options.order = {.distance_weight = 1.2, .conflict_weight = 20.0};
  Limits limits = unlimited();
  return solve_cbs(it, options, limits).statistics.expansions;
}

}  // namespace

TEST("plans are sound, their cost is within the bound, and the bound below the optimum") {
  Random random(11);
  int solved = 0;
  for (int k = 0; k < 300; ++k) {
    const Instance it = random_instance(random, 3, 3, 2 + random.below(2));
    if (least_makespan(it) < 0) continue;
    Limits all = unlimited(), little(kForever, 2 << 20);  // plain searches may take forever
    const Result best = solve_cbs(it, {}, all);
    const CbsOptions options = draw(random);
    const Result result = solve_cbs(it, options, little);
    CHECK(result.lower_bound <= static_cast<double>(sum_of_costs(best)));
    CHECK(result.status == Status::solved || result.status == Status::out_of_memory);
    if (result.status != Status::solved) continue;
    CHECK(faults(it, result) == 0);
    CHECK(static_cast<double>(sum_of_costs(result)) <= options.w * result.lower_bound);
    CHECK(sum_of_costs(result) >= sum_of_costs(best));
    ++solved;
  }
  CHECK(solved > 100);
}

TEST("prioritized conflicts and the pair heuristic save expansions") {
  Random random(3);
  std::int64_t all = 0, without_priorities = 0, without_pairs = 0;
  for (int k = 0; k < 10; ++k) {
    const Instance it = random_instance(random, 8, 8, 10);
    all += expansions(it, 1.03, {});
    without_priorities += expansions(it, 1.03, {.prioritize = false});
    without_pairs += expansions(it, 1.03, {.heuristic = false});
  }
  CHECK(all < without_priorities && all < without_pairs);
}

TEST("rectangle reasoning resolves a crossing in an open field in few expansions") {
  const Instance it = instance(grid(5, 5), {robot(5, 19), robot(1, 23)});  // rightwards and down, downwards and right
  CHECK(expansions(it, 1.0, {.heuristic = false}) < 5);
  CHECK(expansions(it, 1.0, {.heuristic = false, .rectangle = false}) > 5);
}
