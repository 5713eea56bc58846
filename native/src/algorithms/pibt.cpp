#include "mrpbench_mapf/algorithms/pibt.hpp"

#include "lacam/configuration_step.hpp"
#include "lacam/configurations.hpp"
#include "mrpbench_mapf/common/arena.hpp"

namespace mrpbench::mapf {

namespace {

using namespace lacam;

void solve(const Instance& instance, const PibtOptions& options, Limits& limits, Result& result) {
  DistanceTables tables(instance, limits);
  if (prove_unsolvable(instance, tables, limits, result)) return;
  const Moves moves(instance, limits);
  ConfigurationStep step(instance, moves, tables, nullptr, options.swap, options.seed, limits);
  const std::vector<std::int32_t> goals = goals_of(instance), first = first_order(instance, tables);
  std::vector<std::int32_t> order = first, reordered = first, next(instance.size());
  Arena<std::int32_t> arena(limits);
  std::vector<Configuration> sequence;
  std::vector<std::int32_t> start;
  for (const Robot& robot : instance.robots()) start.push_back(robot.start);
  sequence.push_back(arena.copy(start).data());
  const int last = options.steps > 0 ? options.steps : 2 * moves.vertex_count() + 1000;
  while (!is_goal(goals, sequence.back())) {
    limits.check_clock();
    if (static_cast<int>(sequence.size()) > last) return;  // it gives up: perhaps it runs in a circle
    std::ranges::fill(next, -1);
    if (!step(sequence.back(), order.data(), next.data())) return;
    ++result.statistics.expansions;
    sequence.push_back(arena.copy(next).data());
    next_order(goals, sequence.back(), order.data(), first, reordered.data());
    std::swap(order, reordered);
  }
  result.paths = paths_of(moves, sequence, instance.size());
  result.status = Status::solved;
}

}  // namespace

Result solve_pibt(const Instance& instance, const PibtOptions& options, Limits& limits) {
  require_plain(instance, "pibt");
  return solve_within(instance, limits, [&](Result& result) { solve(instance, options, limits, result); });
}

}  // namespace mrpbench::mapf
