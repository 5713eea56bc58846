#include "algorithms/multi_start.hpp"

namespace mrpbench::mapf {

MultiStart::MultiStart(lacam::ConfigurationSpace& space, DistanceTables& tables, lns::Schedule& schedule,
                       const LacamOptions& options)
    : space_(space),
      tables_(tables),
      schedule_(schedule),
      options_(options),
      improvement_(schedule, options.objective, std::nullopt, options.seed),
      limits_(schedule.limits()) {}

bool MultiStart::advance() {
  if (!best_) is_best();
  if (search_) return search() && is_best();
  if (improvement_.advance()) {
    idle_ = 0;
    return is_best();
  }
  if (++idle_ >= kIdle) {
    ++options_.seed;
    steps_ = 0;
    limits_ = schedule_.limits();
    search_.emplace(schedule_.instance(), space_, tables_, nullptr, options_, limits_, statistics_);
  }
  return false;
}

/// Look on for another first plan; true if there is one in the schedule.
bool MultiStart::search() {
  const bool found = search_->advance();
  if (!found && ++steps_ < kPatience && !search_->exhausted()) return false;
  if (found) schedule_.replace(space_.paths_of(search_->way()));
  search_.reset();
  idle_ = 0;
  return found;
}

bool MultiStart::is_best() {
  const Value now = value(options_.objective, schedule_.paths());
  if (best_ && now >= *best_) return false;
  best_ = now;
  return true;
}

}  // namespace mrpbench::mapf
