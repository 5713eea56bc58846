#include "mrpbench_mapf/algorithms/pibt.hpp"

#include "algorithms/returns.hpp"
#include "lacam/configuration_space.hpp"
#include "mrpbench_mapf/common/arena.hpp"

namespace mrpbench::mapf {

namespace {

using namespace lacam;

void solve(const Instance& instance, const PibtOptions& options, Limits& limits, Result& result) {
  DistanceTables tables(instance, limits);
  ConfigurationSpace space(instance, limits);
  if (space.prove_unsolvable(tables, limits, result)) return;
  const auto start = space.start();
  if (!start) return;
  const bool ends_in_window = instance.rules().horizon != kForever;
  // Robots that change places take many steps, and the next window may begin anywhere among them.
  const auto step = space.generator(tables, nullptr, options.swap && !ends_in_window, options.seed, limits);
  const std::vector<std::int32_t> goals = goals_of(instance), first = first_order(instance, tables);
  std::vector<std::int32_t> order = first, reordered = first, next(instance.size());
  Arena<std::int32_t> arena(limits);
  std::vector<Configuration> sequence;
  sequence.push_back(arena.copy(*start).data());
  const int last = options.steps > 0 ? options.steps : 2 * space.moves().vertex_count() + 1000;
  const auto within = static_cast<std::size_t>(space.steps_within(instance.rules().horizon));
  while (!is_goal(goals, sequence.back()) && sequence.size() <= within) {
    limits.check_clock();
    if (static_cast<int>(sequence.size()) > last) return;  // it gives up: perhaps it runs in a circle
    std::ranges::fill(next, -1);
    if (!(*step)(sequence.back(), order.data(), next.data())) return;
    ++result.statistics.expansions;
    sequence.push_back(arena.copy(next).data());
    if (ends_in_window) continue;  // a robot arrives only if it is still there at the end, so it keeps its place
    next_order(goals, sequence.back(), order.data(), first, reordered.data());
    std::swap(order, reordered);
  }
  result.paths = space.paths_of(sequence);
  if (ends_in_window) leave_out_returns(instance, Relations(instance, limits), result.paths, limits);
  result.status = Status::solved;
}

}  // namespace

Result solve_pibt(const Instance& instance, const PibtOptions& options, Limits& limits) {
  require_suitable(instance, "pibt");
  return solve_within(instance, limits, [&](Result& result) { solve(instance, options, limits, result); });
}

}  // namespace mrpbench::mapf
