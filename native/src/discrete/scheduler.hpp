// Gives tasks to robots, greedily.
#pragma once

#include <vector>

#include "mrpbench_discrete/distance_tables.hpp"
#include "mrpbench_discrete/tasks.hpp"

namespace mrpbench::discrete {

/// Robots and tasks by increasing 5 * (way to the first errand) + (way through the rest of the task), as the winner of
/// the League of Robot Runners 2024 weighs them. With clustered tables ways are lower bounds.
class Scheduler {
 public:
  Scheduler(const Problem& problem, DistanceTables& tables) : problem_(problem), tables_(tables) {}

  /// Choose among unopened tasks for robots that are or will be free.
  ///
  /// `pose`: where robots are once they are free. `later`: cost until then, none if empty. `robots`: who may get a
  /// task. `tasks`: which may be given. `most`: how many are given. Returns a task for each of `robots`, -1 = none.
  std::vector<std::int32_t> choose(const Tasks& all, const std::vector<Pose>& pose,
                                   const std::vector<std::int32_t>& robots, const std::vector<std::int32_t>& tasks,
                                   std::size_t most, const std::vector<std::uint32_t>& later = {});
  /// The cost from an errand of a task to the end of that task.
  std::uint32_t rest(const Tasks& all, int task, int errand);
  /// Whether tasks that nobody has begun are given again to so many robots: above some millions of pairs that takes
  /// too long.
  static bool reassigns(std::size_t robots, std::size_t tasks) { return robots * tasks <= 20'000'000; }

 private:
  const Problem& problem_;
  DistanceTables& tables_;
  std::vector<std::int64_t> rest_;
};

}  // namespace mrpbench::discrete
