// True distances to a set of goals by one backward search that runs only as far as it is asked: the heuristic of
// Silver, "Cooperative Pathfinding", AIIDE 2005 (reverse resumable A*), here without a heuristic of its own so that one
// table serves every robot with the same goals and motion profile.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/instance.hpp"
#include "mrpbench_mapf/model/objective.hpp"
#include "mrpbench_mapf/single_agent/distances.hpp"

namespace mrpbench::mapf {

class DistanceTable {
 public:
  /// With `then`, robots go on from the goals as it says. In `pages`, it takes less memory and more time.
  DistanceTable(const Roadmap& roadmap, int profile, std::span<const int> goals, Limits& limits,
                DistanceTable* then = nullptr, bool pages = false);
  /// Go on in another call, whose limits hold from now on.
  void go_on(Limits& limits);
  bool in_pages() const { return distance_.in_pages(); }

  /// Ticks from `vertex` to the nearest goal, or to the end of the shortest way over the goals; kForever if there is
  /// none.
  Tick operator()(int vertex) {
    Tick distance = distance_[vertex];
    while (distance > final_) {
      advance();
      distance = distance_[vertex];
    }
    return distance;
  }

 private:
  struct Entry {
    Tick distance;
    std::int32_t vertex;
    bool operator>(const Entry& other) const {
      return distance != other.distance ? distance > other.distance : vertex > other.vertex;
    }
  };
  void advance();
  void advance_level();
  void advance_heap();

  const Roadmap& roadmap_;
  Limits* limits_;
  std::span<const Tick> duration_;
  Tick shortest_ = kForever;  // least and greatest duration of an edge
  Tick longest_ = 0;
  bool uniform_;  // vertices are found in the order of their distances
  Distances distance_;
  std::vector<std::int32_t> level_, found_;  // uniform: of one distance, from `next_` on, and of the next one
  std::size_t next_ = 0;
  std::vector<Entry> heap_;  // not uniform
  std::size_t counted_ = 0;
  Tick final_ = 0;  // distances up to this one are final
};

/// The tables of one roadmap that the last solver had, for the next one: most robots then have the same goals.
class DistanceCache {
 public:
  using Key = std::pair<int, std::vector<int>>;  // motion profile and goals
  using Tables = std::map<Key, std::unique_ptr<DistanceTable>>;

  explicit DistanceCache(std::shared_ptr<const Roadmap> roadmap) : roadmap_(std::move(roadmap)) {}
  ~DistanceCache();
  const std::shared_ptr<const Roadmap>& roadmap() const { return roadmap_; }
  /// Null if there is none.
  std::unique_ptr<DistanceTable> take(const Key& key);
  /// Forget all others.
  void keep(Tables tables);

 private:
  std::shared_ptr<const Roadmap> roadmap_;  // which the tables refer to
  std::mutex mutex_;
  Tables tables_;
};

/// One table per robot, shared between robots with equal goals and profile.
class DistanceTables {
 public:
  DistanceTables(const Instance& instance, Limits& limits);
  ~DistanceTables();
  DistanceTables(const DistanceTables&) = delete;
  DistanceTables& operator=(const DistanceTables&) = delete;
  /// What a robot has to go once its beginning is over: over all goals that it has not visited then.
  DistanceTable& operator[](int robot) { return *remaining(robot).front(); }
  /// The same, then what it has to go after each of these goals, in order.
  const std::vector<DistanceTable*>& remaining(int robot) const { return remaining_[robot]; }
  /// Sum of costs if every robot were alone: a lower bound. All of them must be able to reach a goal.
  Cost sum_of_costs(const Instance& instance);
  /// The same for the latest arrival.
  Cost makespan(const Instance& instance);
  /// The one of these that `objective` asks for.
  Cost least(Objective objective, const Instance& instance) {
    return objective == Objective::flowtime ? sum_of_costs(instance) : makespan(instance);
  }
  /// Of one robot.
  Cost least_cost(const Instance& instance, int robot);

 private:
  std::shared_ptr<DistanceCache> cache_;
  DistanceCache::Tables tables_;
  std::vector<std::unique_ptr<DistanceTable>> onward_;  // to goals from which robots go on
  std::vector<std::vector<DistanceTable*>> remaining_;  // by robot
};

}  // namespace mrpbench::mapf
