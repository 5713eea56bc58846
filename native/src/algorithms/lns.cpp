#include "mrpbench_mapf/algorithms/lns.hpp"

#include "lacam/lacam_search.hpp"
#include "lns/improvement.hpp"
#include "lns/repair.hpp"
#include "mrpbench_mapf/infeasibility/solvability.hpp"

namespace mrpbench::mapf {

namespace {

using namespace lns;

class Lns {
 public:
  Lns(const Instance& instance, const LnsOptions& options, Limits& limits, Result& result)
      : instance_(instance), options_(options), limits_(limits), result_(result), tables_(instance, limits) {}

  void solve() {
    if (const auto robot = find_cut_off_robot(instance_, tables_, limits_)) return result_.no_plan_for(*robot);
    result_.lower_bound = static_cast<double>(tables_.sum_of_costs(instance_));
    least_ = static_cast<double>(tables_.least(options_.objective, instance_));
    const Relations relations(instance_, limits_);
    if (const auto robot = find_clash(instance_, relations, limits_)) return result_.no_plan_for(*robot);
    Schedule schedule(instance_, tables_, relations, options_.seed, limits_, result_.statistics);
    if (!begin(schedule)) return;
    Improvement improvement(schedule, options_.objective, options_.neighbourhood, options_.seed);
    for (std::int64_t k = 0; (!options_.iterations || k < *options_.iterations) && !improvement.is_done(); ++k) {
      ++result_.statistics.expansions;
      if (!improvement.advance()) continue;
      improvement.copy_changed(result_.paths);
      note();
    }
  }

 private:
  void keep(std::vector<Path> paths) {
    result_.paths = std::move(paths);
    note();
  }

  void note() {
    result_.note(limits_.seconds(), static_cast<double>(value(options_.objective, result_.paths).first), least_);
  }

  /// Put a plan without conflicts into `schedule` and the result, or set the status.
  bool begin(Schedule& schedule) {
    const bool by_lacam = options_.initial != Initial::repair && lacam::is_suitable(instance_);
    if (by_lacam) {
      lacam::ConfigurationSpace space(instance_, limits_);
      if (space.is_unit()) {
        if (!begin_by_lacam(space)) return false;
        if (options_.initial == Initial::either && !is_crowded()) repair(schedule, Patience::brief(instance_.size()));
      } else if (!repair(schedule, space.start() ? Patience{.effort = kEffort} : Patience{}) && space.start()) {
        begin_by_lacam(space);
      }
    } else {
      repair(schedule, {});
    }
    if (result_.status != Status::solved) return false;
    schedule.replace(result_.paths);
    return true;
  }

  /// So many robots are in one another's way that repairing would take too long.
  bool is_crowded() const {
    return static_cast<double>(value(Objective::flowtime, result_.paths).first) > kCrowded * result_.lower_bound;
  }

  bool begin_by_lacam(lacam::ConfigurationSpace& space) {
    LacamOptions options;
    options.seed = options_.seed;
    Statistics of_search;
    lacam::LacamSearch search(instance_, space, tables_, nullptr, options, limits_, of_search);
    const bool found = search.find_first();
    if (found) {
      result_.status = Status::solved;
      keep(space.paths_of(search.way()));
    } else if (space.misses_no_plan()) {
      result_.status = Status::unsolvable;
    }
    return found;
  }

  /// Take the repaired plan if it is cheaper than the one there is. False if patience ran out before there was one.
  bool repair(Schedule& schedule, Patience patience) {
    Repair repair(schedule, options_.neighbourhood.value_or(Repair::kNeighbourhood), options_.seed);
    if (options_.iterations) patience.iterations = *options_.iterations;
    if (!repair.run(patience, result_.statistics.expansions)) return false;
    const bool better = value(options_.objective, schedule.paths()) < value(options_.objective, result_.paths);
    if (result_.status != Status::solved || better) keep(schedule.paths());
    result_.status = Status::solved;
    return true;
  }

  static constexpr double kCrowded = 2;   // times the cost of robots alone
  static constexpr double kEffort = 100;  // of repairing, times that of the first paths
  const Instance& instance_;
  const LnsOptions& options_;
  Limits& limits_;
  Result& result_;
  DistanceTables tables_;
  double least_ = 0;  // what the objective is at least
};

}  // namespace

Result solve_lns(const Instance& instance, const LnsOptions& options, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) { Lns(instance, options, limits, result).solve(); });
}

}  // namespace mrpbench::mapf
