// How a solver ended, and with what.
#pragma once

#include <limits>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/instance.hpp"

namespace mrpbench::mapf {

struct Statistics {
  std::int64_t expansions = 0;            // nodes of the upper search; without one, searches for a single robot
  std::int64_t generated = 0;             // nodes of the upper search that were created
  std::int64_t low_level_expansions = 0;  // states expanded in searches for a single robot
  std::int64_t low_level_generated = 0;
  std::int64_t bypasses = 0;         // conflicts that were bypassed instead of branched on
  std::int64_t pair_expansions = 0;  // nodes of upper searches for two robots, made for a lower bound
  std::int64_t assignments = 0;      // of robots to goals that were tried, if the solver assigns
  std::int64_t restarts = 0;         // further priority orders that were tried
  std::int64_t memory_bytes = 0;     // that the solver counted
  int failed_robot = -1;             // the robot for which no path was found, -1 = none
};

using Path = std::vector<Occupation>;

/// A point of an anytime curve: what the solver had after some time.
struct Progress {
  double seconds;
  double cost;  // what the solver minimises; infinity = no plan yet
  double lower_bound;
};

struct Result {
  Status status = Status::gave_up;
  bool clock_bound = false;       // solved, but the clock ended the search for a better plan
  std::vector<Progress> history;  // of solvers that improve their plan or bound, oldest first
  std::vector<Path> paths;        // one per robot if solved
  double lower_bound = std::numeric_limits<double>::quiet_NaN();
  Statistics statistics;

  /// Add a point to the history; a point shortly after another one replaces it, except the first.
  void note(double seconds, double cost, double bound);
  /// Set the status to unsolvable because of `robot` (-1 = no single robot).
  void no_plan_for(int robot);
  /// A limit ended the solver: keep a complete plan, drop an incomplete one.
  void stop(Status limit);
};

/// Tick at which the last move ends, 0 if the robot never moves.
inline Tick arrival(std::span<const Occupation> path) {
  return path.back().begin / 2;
}

/// The timed path of `robot` as segments, beginning with its committed ones unchanged.
std::vector<Segment> segments(const Instance& instance, int robot, const Path& path);

/// Call `body()`; a limit that it reaches ends the search for `result`.
template <class Body>
void search_within_limits(Result& result, Body body) {
  try {
    body();
  } catch (const LimitReached& limit) {
    result.stop(limit.status);
  } catch (const std::bad_alloc&) {
    result.stop(Status::out_of_memory);
  }
}

/// What `body(result)` makes of a result until it ends or reaches a limit: the frame of every solver.
template <class Body>
Result solve_within(const Instance& instance, Limits& limits, Body body) {
  Result result;
  search_within_limits(result, [&] {
    limits.charge(instance.bytes());
    body(result);
  });
  result.statistics.memory_bytes = limits.memory_used();
  return result;
}

}  // namespace mrpbench::mapf
