// The input of a solver: robots on a roadmap, with goals, released prefixes and rules.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "mrpbench_mapf/model/roadmap.hpp"

namespace mrpbench::mapf {

/// One segment of a timed path; edge -1 waits.
struct Segment {
  std::int32_t edge;
  Tick enter;
  Tick leave;
};

struct Robot {
  int profile = 0;
  double radius = 0.0;  // metres
  int start = 0;
  Tick ready = 0;                     // stands at its start at least until then
  std::vector<int> goals;             // reaching any one counts
  std::vector<std::vector<int>> via;  // goals to visit before, in order: of each set any one counts
  std::vector<Segment> committed;     // the path must begin with these
  int rank = 0;                       // those with lower ranks go first, where a planner has an order
};

struct Rules {
  bool following_forbidden = false;
  bool disappear_at_goal = false;
  /// No conflict although each robot may be up to `k` ticks late anywhere: k-robust plans of Atzmon et al., "Robust
  /// Multi-Agent Path Finding and Executing", JAIR 2020.
  Tick k = 0;
  /// Conflicts that begin later need not be resolved, and paths need not lead to goals beyond: the window of Li et al.,
  /// "Lifelong Multi-Agent Path Finding in Large-Scale Warehouses", AAAI 2021.
  Tick horizon = kForever;
};

/// Pairs of elements closer than some distance, as sparse rows (`mrpbench_core.model.planning.conflicts.Exclusions`).
/// Empty: robots have no footprint.
struct Exclusions {
  std::vector<std::int64_t> first;
  std::vector<std::int32_t> element;
  std::vector<double> distance;  // metres
};

/// Elements that at most `capacity` robots use at a time, each for `setup` ticks longer than it is on them (rule 6). An
/// instance counts the ticks that a robot may be late as setup.
struct Resource {
  int capacity;
  Tick setup;
  std::vector<int> elements;
};

/// What is fixed of a path: the committed segments of a robot, then the stay where they end until it may move.
struct Beginning {
  std::vector<Occupation> occupied;  // the last one is the stay at `vertex`, from arrival to `free_at`
  int vertex;
  Tick free_at;     // earliest next departure
  int visited = 0;  // leading sets of `Robot::via` that it visits
};

/// How many leading sets of `via` a robot has visited once it is at `vertex`, if it had visited `visited` before.
inline int visited_at(int vertex, const std::vector<std::vector<int>>& via, int visited) {
  while (visited < static_cast<int>(via.size()) && std::ranges::find(via[visited], vertex) != via[visited].end()) {
    ++visited;
  }
  return visited;
}

class DistanceCache;  // see single_agent/distance_table.hpp

class Instance {
 public:
  /// Solvers take distances from the cache, which must be of the same roadmap, and leave there what they found; null =
  /// there is none. Throws std::invalid_argument naming the robot with invalid data.
  Instance(std::shared_ptr<const Roadmap> roadmap, std::vector<Robot> robots, Rules rules, Exclusions exclusions,
           std::vector<Resource> resources = {}, std::shared_ptr<DistanceCache> distances = nullptr);
  Instance(Roadmap roadmap, std::vector<Robot> robots, Rules rules, Exclusions exclusions,
           std::vector<Resource> resources = {})
      : Instance(std::make_shared<const Roadmap>(std::move(roadmap)), std::move(robots), rules, std::move(exclusions),
                 std::move(resources)) {}

  const Roadmap& roadmap() const { return *roadmap_; }
  const std::shared_ptr<DistanceCache>& distances() const { return distances_; }
  const std::vector<Robot>& robots() const { return robots_; }
  const Rules& rules() const { return rules_; }
  const Exclusions& exclusions() const { return exclusions_; }
  const std::vector<Resource>& resources() const { return resources_; }
  /// Which of them a robot on `element` uses.
  std::span<const std::int32_t> resources_of(int element) const {
    if (resources_.empty()) return {};
    return resources_of_[element];
  }
  const Beginning& beginning(int robot) const { return beginnings_[robot]; }
  int size() const { return static_cast<int>(robots_.size()); }
  /// Memory in bytes, without the robots.
  std::size_t bytes() const;
  bool footprints() const { return !exclusions_.first.empty(); }
  /// Two elements closer than this exclude the two robots from one another.
  double reach(int one, int other) const {
    return footprints() ? robots_[one].radius + robots_[other].radius - 1e-9 : 0.0;
  }

 private:
  Beginning begin(int robot) const;
  void validate() const;
  void validate_robot(int robot) const;

  std::shared_ptr<const Roadmap> roadmap_;
  std::shared_ptr<DistanceCache> distances_;
  std::vector<Robot> robots_;
  Rules rules_;
  Exclusions exclusions_;
  std::vector<Resource> resources_;
  std::vector<std::vector<std::int32_t>> resources_of_;  // by element; empty if there are none at all
  std::vector<Beginning> beginnings_;
};

}  // namespace mrpbench::mapf
