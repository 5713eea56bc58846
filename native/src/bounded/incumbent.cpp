#include "mrpbench_mapf/bounded/incumbent.hpp"

#include "lns/improvement.hpp"
#include "lns/repair.hpp"
#include "mrpbench_mapf/prioritized.hpp"

namespace mrpbench::mapf {

namespace {
constexpr int kRestarts = 100;           // of planning in turn
constexpr std::int64_t kOverhead = 100;  // what a step takes besides, in expansions
}  // namespace

/// Repairs until there is a plan without conflicts, then improves it.
class Incumbent::Search {
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

Incumbent::Incumbent(const Instance& instance, DistanceTables& distances, Limits& limits, Statistics& statistics)
    : statistics_(statistics) {
  const std::int64_t before = statistics.low_level_expansions;
  if (instance.resources().empty()) {
    search_ = std::make_unique<Search>(instance, distances, limits, statistics);
  } else {
    Result first = solve_prioritized(instance, {.restarts = kRestarts}, limits);
    statistics.low_level_expansions += first.statistics.low_level_expansions;
    statistics.low_level_generated += first.statistics.low_level_generated;
    if (first.status == Status::solved) keep(std::move(first.paths));
  }
  effort_ = statistics.low_level_expansions - before;
}

Incumbent::~Incumbent() = default;

void Incumbent::advance(std::int64_t effort) {
  bool better = false;
  while (search_ != nullptr && !search_->is_done() && effort_ < effort) {
    const std::int64_t before = statistics_.low_level_expansions;
    better |= search_->advance();
    effort_ += statistics_.low_level_expansions - before + kOverhead;
  }
  if (better) keep(search_->paths());
}

void Incumbent::keep(std::vector<Path> paths) {
  paths_ = std::move(paths);
  cost_ = value(Objective::flowtime, paths_).first;
}

}  // namespace mrpbench::mapf
