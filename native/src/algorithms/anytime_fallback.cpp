#include "algorithms/anytime_fallback.hpp"

#include "algorithms/multi_start.hpp"
#include "lns/repair.hpp"

namespace mrpbench::mapf {

namespace {
constexpr std::int64_t kOverhead = 100;  // of a step, besides its expansions, in expansions
}  // namespace

/// Repairs until there is a plan without conflicts, or LaCAM has found one; then improves it.
class AnytimeFallback::Search {
 public:
  Search(const Instance& instance, DistanceTables& distances, Limits& limits, Statistics& statistics)
      : relations_(instance, limits),
        schedule_(instance, distances, relations_, 0, limits, statistics),
        repair_(schedule_, lns::Repair::kNeighbourhood, 0),
        improvement_(schedule_, Objective::flowtime, std::nullopt, 0),
        is_done_(!repair_.begin()) {
    if (!lacam::is_suitable(instance)) return;
    space_.emplace(instance, limits);
    if (space_->is_unit()) return;
    lacam_.emplace(instance, *space_, distances, nullptr, LacamOptions{}, limits, of_lacam_);
    multi_start_.emplace(*space_, distances, schedule_, LacamOptions{});
  }

  const std::vector<Path>& paths() const { return schedule_.paths(); }
  /// No better plan can be found.
  bool is_done() const { return is_done_; }

  /// Take a step; true if there is a better plan now.
  bool advance() {
    if (found_ || repair_.is_done()) {
      const bool better = !found_ || (multi_start_ ? multi_start_->advance() : improvement_.advance());
      found_ = true;
      is_done_ = improvement_.is_done();
      return better;
    }
    repair_.advance();
    if (!lacam_ || lacam_->exhausted() || !lacam_->advance()) return false;
    schedule_.replace(space_->paths_of(lacam_->way()));
    found_ = true;
    return true;
  }

 private:
  Relations relations_;
  lns::Schedule schedule_;
  lns::Repair repair_;
  lns::Improvement improvement_;
  std::optional<lacam::ConfigurationSpace> space_;
  std::optional<lacam::LacamSearch> lacam_;  // where repairing alone may take long: moves of several ticks, resources
  std::optional<MultiStart> multi_start_;
  Statistics of_lacam_;
  bool found_ = false;  // a plan without conflicts
  bool is_done_;
};

AnytimeFallback::AnytimeFallback(SearchContext& context, Result& result) : context_(context), result_(result) {}

AnytimeFallback::~AnytimeFallback() = default;

bool AnytimeFallback::solve() {
  const CbsOptions& options = context_.options;
  if (!options.incumbent_after || options.goals != GoalChoice::own) return false;
  const std::int64_t effort = result_.statistics.low_level_expansions - effort_;
  if (!root_effort_) root_effort_ = effort;
  if (effort < *root_effort_ + *options.incumbent_after) return false;
  if (!begun_) begin();
  advance(effort / 2);
  if (static_cast<double>(cost_) > options.w * result_.lower_bound) return false;
  result_.paths = paths_;
  result_.status = Status::solved;
  return true;
}

void AnytimeFallback::begin() {
  begun_ = true;
  Statistics& statistics = result_.statistics;
  const std::int64_t before = statistics.low_level_expansions;
  const Instance& instance = context_.space.instance();
  search_ = std::make_unique<Search>(instance, context_.distances, context_.limits, statistics);
  effort_ = statistics.low_level_expansions - before;
}

/// Continue until the search has taken `effort` in total.
void AnytimeFallback::advance(std::int64_t effort) {
  while (!search_->is_done() && effort_ < effort) {
    const std::int64_t before = result_.statistics.low_level_expansions;
    if (search_->advance()) keep(search_->paths());
    effort_ += result_.statistics.low_level_expansions - before + kOverhead;
  }
}

void AnytimeFallback::keep(std::vector<Path> paths) {
  paths_ = std::move(paths);
  cost_ = value(Objective::flowtime, paths_).first;
}

}  // namespace mrpbench::mapf
