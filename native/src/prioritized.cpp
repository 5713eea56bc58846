#include "mrpbench_mapf/prioritized.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <set>

#include "mrpbench_mapf/reservations.hpp"
#include "mrpbench_mapf/sipp.hpp"
#include "mrpbench_mapf/solvability.hpp"

namespace mrpbench::mapf {

namespace {

using Priorities = std::vector<int>;

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
  std::optional<int> plan(const Priorities& order) {
    reservations_.clear();
    reserve_beginnings(instance_, reservations_);
    for (const int robot : order) {
      ++statistics_.generated;
      if (!sipp_.search(robot, tables_[robot], Others(reservations_, robot), paths_[robot])) return robot;
      ++statistics_.expansions;
      reservations_.add(robot, paths_[robot]);
    }
    return std::nullopt;
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
  const auto unsolvable = [&](int robot) {
    statistics.failed_robot = robot;
    result.status = Status::unsolvable;
  };
  DistanceTables tables(instance, limits);
  if (const auto robot = find_cut_off_robot(instance, tables, limits)) return unsolvable(*robot);
  result.lower_bound = static_cast<double>(tables.sum_of_costs(instance));
  const Relations relations(instance, limits);
  if (const auto robot = find_clash(instance, relations, limits)) return unsolvable(*robot);

  Prioritized search(instance, tables, relations, limits, statistics);
  std::mt19937_64 random(options.seed);
  Priorities order = first_order(instance, options.order, tables, random);
  std::set<Priorities> tried;
  while (const auto failed = search.plan(order)) {
    if (*failed == order.front()) return unsolvable(*failed);  // only what is certain stood in its way
    statistics.failed_robot = *failed;
    if (statistics.restarts == options.restarts) return;
    ++statistics.restarts;
    tried.insert(order);
    reorder(order, *failed, tried, random);
  }
  statistics.failed_robot = -1;
  result.paths = std::move(search.paths());
  result.status = Status::solved;
}

}  // namespace

Result solve_prioritized(const Instance& instance, const PrioritizedOptions& options, Limits& limits) {
  Result result;
  try {
    solve(instance, options, limits, result);
  } catch (const LimitReached& limit) {
    result.status = limit.status;
  } catch (const std::bad_alloc&) {
    result.status = Status::out_of_memory;
  }
  return result;
}

}  // namespace mrpbench::mapf
