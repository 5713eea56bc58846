// Which moves of several robots can follow one another in one step of a search over configurations, where moves take
// several ticks and robots have footprints, use resources or keep other rules of conflicts. A robot that sets out needs
// its edge and the vertex at its end for itself; so a step is a sequence of rounds, and the moves of a round start
// together.
#pragma once

#include <algorithm>

#include "lacam/configurations.hpp"
#include "mrpbench_mapf/model/relations.hpp"

namespace mrpbench::mapf::lacam {

/// A robot that goes from one vertex to the next, or stays (`edge` -1). All three are elements of the roadmap.
struct Move {
  std::int32_t robot, from, edge, to;
};

class JointMoves {
 public:
  /// An element that a robot must not be on beside one on another element, if their reach is greater.
  struct Excluded {
    std::int32_t element;
    double distance;  // metres; -1: always
    bool delayed;     // not even one right after the other, because of a resource that takes time to set up
  };

  JointMoves(const Instance& instance, const Relations& relations, const Moves& moves, Limits& limits);

  Move move(int robot, int from, int to) const;
  std::span<const Excluded> excluded(int element) const {
    return {excluded_.data() + first_[element], excluded_.data() + first_[element + 1]};
  }
  bool applies(const Excluded& excluded, int one, int other) const {
    return excluded.distance < instance_.reach(one, other);
  }
  bool excludes(int one, int element, int other, int other_element) const;
  /// Tell whether both robots can move in one round.
  bool fit_together(const Move& one, const Move& other) const;
  /// Tell whether `one` can move first, and `other` after it.
  bool fit_in_turn(const Move& one, const Move& other) const;
  /// Resources that hold several robots.
  const std::vector<std::int32_t>& roomy() const { return roomy_; }
  bool uses(int element, int resource) const {
    return element >= 0 && std::ranges::count(instance_.resources_of(element), resource) > 0;
  }

  /// Tell whether all robots can be at their vertices at the same time.
  bool is_allowed(Configuration at);
  /// The rounds of a step; false if there are none.
  bool rounds(Configuration from, Configuration to, std::vector<std::vector<Move>>& rounds);
  /// Where there is a plan, there is one of such steps: on every edge a robot excludes all that it excludes at its end,
  /// or every move takes one tick.
  bool misses_no_plan() const;

 private:
  void add_excluded(const Relations& relations, int element, double reach);
  bool is_in_way(const Move& move, int other, int vertex) const;
  bool delays(const Move& move, int vertex) const;
  void choose(std::vector<Move>& round);
  bool drop_blocked(std::vector<Move>& round);
  bool drop_crowded(std::vector<Move>& round);
  int late(const Move& move) const;
  bool uses_as_much(int element, int other) const;
  bool excludes_as_much(int element, int other) const;
  void drop(std::vector<Move>& round, int robot);

  const Instance& instance_;
  const Moves& moves_;
  std::vector<std::size_t> first_;
  std::vector<Excluded> excluded_;  // sorted by element in each row
  std::vector<std::int32_t> roomy_;
  // of the present step
  std::vector<std::int32_t> standing_;  // robot by vertex, -1 = none
  std::vector<std::int32_t> claimed_;   // robot of the round by element that it moves on or to, -1 = none
  std::vector<Move> moving_;            // by robot, of the round
};

}  // namespace mrpbench::mapf::lacam
