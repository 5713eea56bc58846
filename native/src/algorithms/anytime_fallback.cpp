#include "algorithms/anytime_fallback.hpp"

#include "lns/improvement.hpp"
#include "lns/repair.hpp"
#include "mrpbench_mapf/algorithms/prioritized.hpp"

namespace mrpbench::mapf {

namespace {
constexpr int kRestarts = 100;           // of planning in turn
constexpr std::int64_t kOverhead = 100;  // what a step takes besides, in expansions
}  // namespace

/// Repairs until there is a plan without conflicts, then improves it.
class AnytimeFallback::Search {
 public:
  Search(const Instance& instance, DistanceTables& distances, Limits& limits, Statistics& statistics)
      : relations_(instance, limits),
        schedule_(instance, distances, relations_, 0, limits, statistics),
        repair_(schedule_, lns::Repair::kNeighbourhood, 0),
        improvement_(schedule_, Objective::flowtime, std::nullopt, 0),
        is_done_(!repair_.begin()) {}

  const std::vector<Path>& paths() const { return schedule_.paths(); }
  /// There is nothing more to look for.
  bool is_done() const { return is_done_; }

  /// Take a step; true if there is a better plan now.
  bool advance() {
    if (repair_.is_done()) {
      const bool better = !found_ || improvement_.advance();
      found_ = true;
      is_done_ = improvement_.is_done();
      return better;
    }
    repair_.advance();
    return false;
  }

 private:
  Relations relations_;
  lns::Schedule schedule_;
  lns::Repair repair_;
  lns::Improvement improvement_;
  bool found_ = false;  // a plan without conflicts
  bool is_done_;
};

AnytimeFallback::AnytimeFallback(SearchContext& context, const BoundedOptions& options, Result& result)
    : context_(context), options_(options), result_(result) {}

AnytimeFallback::~AnytimeFallback() = default;

bool AnytimeFallback::solve() {
  if (!options_.incumbent_after || options_.techniques.goals != GoalChoice::own) return false;
  const std::int64_t effort = result_.statistics.low_level_expansions - effort_;
  if (!root_effort_) root_effort_ = effort;
  if (effort < *root_effort_ + *options_.incumbent_after) return false;
  if (!begun_) begin();
  advance(effort / 2);
  if (static_cast<double>(cost_) > options_.w * result_.lower_bound) return false;
  result_.paths = paths_;
  result_.status = Status::solved;
  return true;
}

void AnytimeFallback::begin() {
  begun_ = true;
  Statistics& statistics = result_.statistics;
  const std::int64_t before = statistics.low_level_expansions;
  const Instance& instance = context_.space.instance();
  if (instance.resources().empty()) {
    search_ = std::make_unique<Search>(instance, context_.distances, context_.limits, statistics);
  } else {
    Result first = solve_prioritized(instance, {.restarts = kRestarts}, context_.limits);
    statistics.low_level_expansions += first.statistics.low_level_expansions;
    statistics.low_level_generated += first.statistics.low_level_generated;
    if (first.status == Status::solved) keep(std::move(first.paths));
  }
  effort_ = statistics.low_level_expansions - before;
}

/// Search on until this has taken `effort` in all.
void AnytimeFallback::advance(std::int64_t effort) {
  bool better = false;
  while (search_ != nullptr && !search_->is_done() && effort_ < effort) {
    const std::int64_t before = result_.statistics.low_level_expansions;
    better |= search_->advance();
    effort_ += result_.statistics.low_level_expansions - before + kOverhead;
  }
  if (better) keep(search_->paths());
}

void AnytimeFallback::keep(std::vector<Path> paths) {
  paths_ = std::move(paths);
  cost_ = value(Objective::flowtime, paths_).first;
}

}  // namespace mrpbench::mapf
