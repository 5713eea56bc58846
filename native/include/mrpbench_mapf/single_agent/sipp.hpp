// Safe interval path planning: the earliest path of one robot among moving obstacles. A state is a vertex with one of
// its safe intervals; within it only the earliest arrival matters.
// Phillips and Likhachev, "SIPP: Safe Interval Path Planning for Dynamic Environments", ICRA 2011.
// Of a robot that visits several goals in order, a state also says how many it has visited, as the labels of
// Grenouilleau, van Hoeve and Hooker, "A Multi-Label A* Algorithm for Multi-Agent Pathfinding", ICAPS 2019.
#pragma once

#include <vector>

#include "mrpbench_mapf/common/lazy_rows.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"
#include "mrpbench_mapf/single_agent/reservations.hpp"

namespace mrpbench::mapf {

class Sipp {
 public:
  Sipp(const Instance& instance, Limits& limits, Statistics& statistics);

  /// Find the path of `robot` with the earliest arrival at its last goal (for good, unless robots disappear there) that
  /// visits those before in order and avoids `obstacles`. `tables` are what it has to go. Writes `path` and returns
  /// true, or false if there is none. Among equally early paths it prefers few conflicts with `others`, as the conflict
  /// avoidance table of Standley, "Finding optimal solutions to cooperative pathfinding problems", AAAI 2010; not
  /// strictly the fewest, since a state keeps only its earliest arrival. With a `delay` the robot stays at its start
  /// that much longer, as far as others let it.
  bool search(int robot, const DistanceTables& tables, const Obstacles& obstacles, Path& path,
              const Reservations* others = nullptr, Tick delay = 0);

 private:
  struct State {
    Tick first, last;  // the safe interval
    Tick arrival;      // earliest so far
    std::int32_t vertex;
    std::int32_t parent;  // state, -1 = none
    std::int32_t edge;    // by which it was reached
    std::int32_t conflicts;
    std::int16_t visited;  // goals, of those to visit before the last one and after the beginning
    bool closed;
  };
  struct Open {
    Tick f, h;
    std::int32_t conflicts;
    std::int32_t state;
    bool operator>(const Open& other) const {
      if (f != other.f) return f > other.f;
      if (conflicts != other.conflicts) return conflicts > other.conflicts;
      if (h != other.h) return h > other.h;
      return state < other.state;
    }
  };
  using Row = LazyRows<State>::Row;

  void begin(int robot, const Obstacles& obstacles, const Reservations* others);
  Row states_of(int vertex, int visited);
  int visited_at(int vertex, int visited) const;
  Tick to_go(int vertex, int visited) { return (*(*remaining_)[visited])(vertex); }
  Tick next_departure(int edge, Tick departure);
  Tick earliest_stay(const Robot& robot);
  void expand(int state);
  bool is_final(int state, Tick h) const {
    return h == 0 && (instance_.rules().disappear_at_goal || states_[state].last == kForever);
  }
  int count_conflicts(const State& from, int edge, Tick departure, const State& to);
  void push(int state);
  void trace(int state, Path& path) const;

  const Instance& instance_;
  const Roadmap& roadmap_;
  Limits& limits_;
  Statistics& statistics_;
  // the current search
  int robot_ = -1;
  const Obstacles* obstacles_ = nullptr;
  const Reservations* others_ = nullptr;
  const std::vector<DistanceTable*>* remaining_ = nullptr;
  std::span<const Tick> duration_;
  Tick least_cost_ = 0;
  LazyRows<State> states_;      // by goals visited, then by vertex
  LazyRows<Range> departures_;  // forbidden ones, by edge
  std::vector<Open> open_;
  std::vector<Range> scratch_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
