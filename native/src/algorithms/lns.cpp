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
    const bool unit = options_.initial != Initial::repair && lacam::is_plain(instance_);
    if (unit && !begin_by_lacam()) return false;
    if (!unit || (options_.initial == Initial::either && !is_crowded())) repair(schedule, unit);
    if (result_.status != Status::solved) return false;
    schedule.replace(result_.paths);
    return true;
  }

  /// So many robots are in one another's way that repairing would take too long.
  bool is_crowded() const {
    return static_cast<double>(value(Objective::flowtime, result_.paths).first) > kCrowded * result_.lower_bound;
  }

  bool begin_by_lacam() {
    const lacam::Moves moves(instance_, limits_);
    LacamOptions options;
    options.seed = options_.seed;
    Statistics of_search;
    lacam::LacamSearch search(instance_, moves, tables_, nullptr, options, limits_, of_search);
    if (!search.find_first()) {
      result_.status = Status::unsolvable;
      return false;
    }
    result_.status = Status::solved;
    keep(lacam::paths_of(moves, search.way(), instance_.size()));
    return true;
  }

  /// Take the repaired plan if it is cheaper than the one there is; with one, only try for a while.
  void repair(Schedule& schedule, bool unit) {
    Repair repair(schedule, options_.neighbourhood.value_or(Repair::kNeighbourhood), options_.seed);
    Patience patience = unit ? Patience::brief(instance_.size()) : Patience{};
    if (options_.iterations) patience.iterations = *options_.iterations;
    if (!repair.run(patience, result_.statistics.expansions)) return;  // stays `gave_up`, or the plan there is
    const bool better = value(options_.objective, schedule.paths()) < value(options_.objective, result_.paths);
    if (result_.status != Status::solved || better) keep(schedule.paths());
    result_.status = Status::solved;
  }

  static constexpr double kCrowded = 2;  // times the cost of robots alone
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
