// What planners of the discrete execution see, and what they answer.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mrpbench_discrete/distance_tables.hpp"
#include "mrpbench_discrete/grid.hpp"

namespace mrpbench::discrete {

/// Where robots are and want to go.
struct View {
  const Grid& grid;
  DistanceTables& tables;
  std::vector<Pose> pose{};
  /// Cell of each robot's next errand and of the one after that; -1 = none.
  std::vector<std::int32_t> goal{}, next_goal{};
  /// Cost from the next errand to the end of the task.
  std::vector<std::uint32_t> rest{};
  /// Two robots may not rotate through each other's cells, and a robot enters a cell that another leaves only behind it
  /// in a straight line: the squares of the 2026 season.
  bool straight_following = false;
};

/// When a planner stops to improve.
struct Budget {
  double seconds = 1;
  std::optional<std::int64_t> iterations;
  ///< If given, the clock is not read: equal inputs give equal answers.
};

class Planner {
 public:
  virtual ~Planner() = default;
  /// The action of every robot in the next step. Executing all of them breaks no rule.
  virtual void plan(const View& view, const Budget& budget, std::vector<Action>& action) = 0;
};

struct PlannerOptions {
  std::string name = "epibt";
  int depth = 4;
  ///< Actions of an operation (EPIBT).
  bool improve = true;
  ///< Large neighbourhood search after the first answer (EPIBT).
  int threads = 1;
  ///< Of the large neighbourhood search; results do not depend on their number, if the clock is not read.
};

/// Throws std::invalid_argument for an unknown name or depth.
std::unique_ptr<Planner> make_planner(const PlannerOptions& options, std::uint64_t seed);

}  // namespace mrpbench::discrete
