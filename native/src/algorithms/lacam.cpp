#include "mrpbench_mapf/algorithms/lacam.hpp"

#include "algorithms/multi_start.hpp"
#include "lacam/arrivals.hpp"
#include "lns/repair.hpp"
#include "lns/spread.hpp"

namespace mrpbench::mapf {

namespace {

using namespace lacam;
using namespace lns;

class Lacam {
 public:
  Lacam(const Instance& instance, ConfigurationSpace& space, DistanceTables& tables, const LacamOptions& options,
        Limits& limits, Result& result)
      : instance_(instance),
        space_(space),
        tables_(tables),
        options_(options),
        limits_(limits),
        result_(result),
        search_(instance, space, tables, nullptr, options, limits, result.statistics) {}

  void solve() {
    if (!search_.find_first()) {
      result_.status = space_.misses_no_plan() ? Status::unsolvable : Status::gave_up;
      return;
    }
    least_ = tables_.least(options_.objective, instance_);
    result_.status = Status::solved;
    keep(space_.paths_of(search_.way()));
    if (options_.iterations != 0 && best_.first > least_) improve();
  }

 private:
  void keep(std::vector<Path> paths) {
    result_.paths = std::move(paths);
    note();
  }

  void note() {
    best_ = value(options_.objective, result_.paths);
    search_.bound(best_.first);
    result_.note(limits_.seconds(), static_cast<double>(best_.first), static_cast<double>(least_));
  }

  void improve() {
    const Relations relations(instance_, limits_);
    Schedule schedule(instance_, tables_, relations, options_.seed, limits_, result_.statistics);
    const bool has_room = !space_.is_unit() || best_.first < kRoom * least_;
    const bool in_turn = options_.prioritized && has_room && plan_in_turn(schedule);
    // What is good for the sum need not be for the last robot.
    const bool enough = in_turn && options_.objective == Objective::flowtime;
    if (options_.guides && space_.is_unit() && !enough) {
      if (best_.first < kCrowded * least_) {
        follow_guide_paths(schedule);
      } else {
        draw_others();
      }
    }
    // Where moves take several ticks, steps say nothing about costs.
    if (best_.first == least_ || !((options_.star && space_.is_unit()) || options_.neighbourhoods)) return;
    schedule.replace(result_.paths);
    if (!space_.is_unit()) return start_often(schedule);
    Improvement improvement(schedule, options_.objective, {}, options_.seed);
    for (std::int64_t k = 0; !options_.iterations || k < *options_.iterations; ++k) {
      if (options_.neighbourhoods && improvement.advance()) {
        improvement.copy_changed(result_.paths);
        note();
      }
      if (options_.star && !search_.exhausted() && search_.advance()) {
        std::vector<Path> paths = space_.paths_of(search_.way());
        if (value(options_.objective, paths) < best_) {
          schedule.replace(paths);
          keep(std::move(paths));
        }
      }
      if (best_.first == least_ || (search_.exhausted() && rule_out_better())) return;
      if (search_.exhausted() && !options_.neighbourhoods) return;
    }
  }

  void start_often(Schedule& schedule) {
    MultiStart multi_start(space_, tables_, schedule, options_);
    for (std::int64_t k = 0; best_.first > least_ && (!options_.iterations || k < *options_.iterations); ++k) {
      if (multi_start.advance()) keep(schedule.paths());
    }
  }

  /// A second plan, one robot after another: where there is room, much cheaper and soon found. False if there is not.
  bool plan_in_turn(Schedule& schedule) {
    Repair repair(schedule, Repair::kNeighbourhood, options_.seed);
    const Patience patience = space_.is_unit() ? Patience::brief(instance_.size()) : Patience{.effort = kEffort};
    if (!repair.run(patience, result_.statistics.expansions)) return false;
    if (value(options_.objective, schedule.paths()) < best_) keep(schedule.paths());
    return true;
  }

  /// Search first plans with other random seeds: among many robots their costs differ by a tenth, and finding another
  /// one takes less time than improving one by as much.
  void draw_others() {
    LacamOptions options = options_;
    const std::int64_t most = 2 * result_.statistics.expansions;
    for (int k = 0; k < kOthers; ++k) {
      ++options.seed;
      LacamSearch search(instance_, space_, tables_, nullptr, options, limits_, result_.statistics);
      for (std::int64_t step = 0; step < most && !search.found(); ++step) search.advance();
      if (!search.found()) continue;
      std::vector<Path> paths = space_.paths_of(search.way());
      if (value(options_.objective, paths) < best_) keep(std::move(paths));
    }
  }

  /// A second plan, along guide paths that avoid one another: slower to find, mostly much cheaper.
  void follow_guide_paths(Schedule& schedule) {
    spread(schedule);
    const GuidePaths guides(schedule.paths());
    LacamSearch search(instance_, space_, tables_, &guides, options_, limits_, result_.statistics);
    // GuidePaths know nothing of changing places: robots that insist on them for too long block one another.
    for (Tick left = guides.longest(); !search.found(); --left) {
      if (left == 0) search.drop_guide_paths();
      search.advance();
    }
    std::vector<Path> paths = space_.paths_of(search.way());
    if (value(options_.objective, paths) < best_) keep(std::move(paths));
  }

  /// When all configurations were seen that a better plan could contain: take the best of all, and true.
  bool rule_out_better() {
    if (options_.objective == Objective::flowtime) {
      if (instance_.size() > kMostRobotsInSet) return false;
      const std::vector<Configuration> way = least_arrivals(search_.graph(), *search_.graph().nodes().front(),
                                                            *search_.goal(), instance_.size(), best_.first, limits_);
      least_ = best_.first;
      if (!way.empty()) {
        std::vector<Path> paths = space_.paths_of(way);
        least_ = value(options_.objective, paths).first;
        keep(std::move(paths));
      }
      result_.lower_bound = static_cast<double>(least_);
    }
    least_ = best_.first;
    result_.note(limits_.seconds(), static_cast<double>(best_.first), static_cast<double>(least_));
    return true;
  }

  // Where a plan costs so many times what robots alone do, the crowd and not their ways is what delays them.
  static constexpr Cost kCrowded = 4;
  static constexpr int kOthers = 40;     // plans to draw there
  static constexpr Cost kRoom = 2;       // and up to so many times, robots can be planned in turn
  static constexpr double kEffort = 10;  // for that, times that of the first paths, where moves take several ticks
  const Instance& instance_;
  ConfigurationSpace& space_;
  DistanceTables& tables_;
  const LacamOptions& options_;
  Limits& limits_;
  Result& result_;
  LacamSearch search_;
  Value best_{};
  Cost least_ = 0;
};

}  // namespace

Result solve_lacam(const Instance& instance, const LacamOptions& options, Limits& limits) {
  require_suitable(instance, "lacam");
  return solve_within(instance, limits, [&](Result& result) {
    DistanceTables tables(instance, limits);
    ConfigurationSpace space(instance, limits);
    if (space.prove_unsolvable(tables, limits, result)) return;
    Lacam(instance, space, tables, options, limits, result).solve();
  });
}

}  // namespace mrpbench::mapf
