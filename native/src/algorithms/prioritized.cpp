#include "mrpbench_mapf/algorithms/prioritized.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <set>

#include "mrpbench_mapf/infeasibility/solvability.hpp"
#include "mrpbench_mapf/single_agent/reservations.hpp"
#include "mrpbench_mapf/single_agent/sipp.hpp"

namespace mrpbench::mapf {

namespace {

using Priorities = std::vector<int>;
using Delays = std::vector<Tick>;  // by robot

/// Restarts in which all robots start as early as they can.
constexpr int kPunctual = 100;

/// Fisher-Yates with the raw generator: std::shuffle differs between standard libraries.
void shuffle(Priorities& order, std::mt19937_64& random) {
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
}

Priorities first_order(const Instance& instance, Order kind, DistanceTables& tables, std::mt19937_64& random) {
  Priorities order(instance.size());
  std::iota(order.begin(), order.end(), 0);
  const auto distance = [&](int robot) { return tables[robot](instance.beginning(robot).vertex); };
  if (kind == Order::longest_first) std::ranges::stable_sort(order, std::greater{}, distance);
  if (kind == Order::shortest_first) std::ranges::stable_sort(order, std::less{}, distance);
  if (kind == Order::random) shuffle(order, random);
  return order;
}

/// The failed robot first; an order that was tried before is shuffled.
void reorder(Priorities& order, int failed, const std::set<Priorities>& tried, std::mt19937_64& random) {
  const auto place = std::ranges::find(order, failed);
  std::rotate(order.begin(), place, place + 1);
  if (tried.contains(order)) shuffle(order, random);
}

/// Half of the robots start up to `longest` late.
void draw(Delays& delays, Tick longest, std::mt19937_64& random) {
  for (Tick& delay : delays) {
    delay = random() % 2 == 0 ? 0 : static_cast<Tick>(random() % (static_cast<std::uint64_t>(longest) + 1));
  }
}

class Prioritized {
 public:
  Prioritized(const Instance& instance, DistanceTables& tables, const Relations& relations, Limits& limits,
              Statistics& statistics)
      : instance_(instance),
        tables_(tables),
        reservations_(instance, relations, limits),
        sipp_(instance, limits, statistics),
        statistics_(statistics),
        paths_(instance.size()) {}

  /// Plan in this order; the robot for which there is no path, or nothing.
  std::optional<int> plan(const Priorities& order, const Delays& delays) {
    reservations_.clear();
    reserve_beginnings(instance_, reservations_);
    for (const int robot : order) {
      ++statistics_.generated;
      const Others others(reservations_, robot);
      if (!sipp_.search(robot, tables_, others, paths_[robot], nullptr, delays[robot])) return robot;
      ++statistics_.expansions;
      reservations_.add(robot, paths_[robot]);
    }
    return std::nullopt;
  }

  /// Replan every robot in turn around the present paths of the others; its old path is one solution.
  void hurry(const Priorities& order) {
    try {
      for (const int robot : order) {
        reservations_.clear();
        for (const int other : order) {
          if (other != robot) reservations_.add(other, paths_[other]);
        }
        sipp_.search(robot, tables_, Others(reservations_, robot), paths_[robot]);
      }
    } catch (const LimitReached&) {  // the plan stays as it is
    }
  }

  std::vector<Path>& paths() { return paths_; }

 private:
  const Instance& instance_;
  DistanceTables& tables_;
  Reservations reservations_;
  Sipp sipp_;
  Statistics& statistics_;
  std::vector<Path> paths_;
};

void solve(const Instance& instance, const PrioritizedOptions& options, Limits& limits, Result& result) {
  Statistics& statistics = result.statistics;
  DistanceTables tables(instance, limits);
  if (const auto robot = find_cut_off_robot(instance, tables, limits)) return result.no_plan_for(*robot);
  result.lower_bound = static_cast<double>(tables.sum_of_costs(instance));
  const Relations relations(instance, limits);
  if (const auto robot = find_clash(instance, relations, limits)) return result.no_plan_for(*robot);

  Prioritized search(instance, tables, relations, limits, statistics);
  std::mt19937_64 random(options.seed);
  Priorities order = first_order(instance, options.order, tables, random);
  Delays delays(instance.size(), 0);
  Tick longest = 0;
  for (int robot = 0; robot < instance.size(); ++robot) {
    longest = std::max(longest, tables[robot](instance.beginning(robot).vertex));
  }
  std::set<Priorities> tried;
  while (const auto failed = search.plan(order, delays)) {
    // Only committed segments of others can block the first robot.
    if (*failed == order.front() && delays[*failed] == 0) return result.no_plan_for(*failed);
    statistics.failed_robot = *failed;
    if (statistics.restarts == options.restarts) return;
    ++statistics.restarts;
    tried.insert(order);
    reorder(order, *failed, tried, random);
    // Robots whose goals block one another have no order that succeeds, unless one lets the other pass before it
    // starts.
    if (statistics.restarts > kPunctual) draw(delays, 2 * longest, random);
  }
  if (std::ranges::any_of(delays, [](Tick delay) { return delay > 0; })) search.hurry(order);
  statistics.failed_robot = -1;
  result.paths = std::move(search.paths());
  result.status = Status::solved;
}

}  // namespace

Result solve_prioritized(const Instance& instance, const PrioritizedOptions& options, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) { solve(instance, options, limits, result); });
}

}  // namespace mrpbench::mapf
