// The roadmap as conflict-based search walks it: the moves out of each vertex in one array for each motion profile,
// what robots do for certain, and whether the instance is classical.
#pragma once

#include <array>
#include <optional>

#include "mrpbench_mapf/cbs/constraints/constraint.hpp"
#include "mrpbench_mapf/single_agent/reservations.hpp"

namespace mrpbench::mapf {

struct Move {
  std::int32_t head;
  std::int32_t edge;
  std::int32_t against;  // `Space::lane` from `head` back, -1 = none; robots on both would swap
  Tick duration;
};

class Space {
 public:
  Space(const Instance& instance, Limits& limits);

  const Instance& instance() const { return instance_; }
  /// Of classical instances, since path tables hold robots in 16 bits.
  static constexpr int kMostRobots = 65'000;
  int vertex_count() const { return instance_.roadmap().vertex_count(); }
  /// Every edge takes one tick, robots have no footprint and may follow one another closely, nothing is a resource:
  /// then only vertices and swaps conflict, and a path is one vertex for each tick. Of parallel edges only the first is
  /// a move.
  bool classical() const { return classical_; }
  /// Some robot does something for certain beyond standing at its start at tick 0.
  bool committed() const { return certain_.has_value(); }
  /// Which elements exclude one another; only unless `classical`, or if `committed`.
  const Relations& relations() const { return *relations_; }
  /// Tell whether only one robot at a time may be at `vertex` and on the edges that end there.
  bool is_junction(int vertex) const { return !junction_.empty() && junction_[vertex]; }
  /// The vertices at which a robot is on an element, or to which the element leads; -1 = no second one.
  std::array<int, 2> ends(int element) const {
    const int edge = element - vertex_count();
    if (edge < 0) return {element, -1};
    return {instance_.roadmap().tail(edge), instance_.roadmap().head(edge)};
  }
  /// Tell whether `element` is the vertex or an edge that ends there.
  bool meets(int element, int vertex) const {
    const std::array<int, 2> both = ends(element);
    return both[0] == vertex || both[1] == vertex;
  }
  /// Moves of `robot` out of `vertex`.
  std::span<const Move> moves(int robot, int vertex) const {
    const Profile& it = profiles_[instance_.robots()[robot].profile];
    return {it.moves.data() + it.first[vertex], it.moves.data() + it.first[vertex + 1]};
  }
  /// The first edge from one vertex to another, by which swaps are recognised, -1 = none.
  int lane(int tail, int head) const;
  /// Classical instances: the edge by which `robot` moves between two neighbouring vertices.
  int edge(int robot, int tail, int head) const;
  /// Constraints on `robot` because of what the others do for certain.
  std::span<const Constraint> certain(int robot) const { return certain_of_[robot]; }
  /// Number of different vertices one can come from or go to directly.
  int degree(int vertex) const;

 private:
  struct Profile {
    std::vector<std::int32_t> first;  // by vertex
    std::vector<Move> moves;
  };
  bool is_classical() const;
  Profile profile(int index) const;
  void find_junctions(Limits& limits);
  void list_certain();

  const Instance& instance_;
  bool classical_;
  std::vector<Profile> profiles_;
  std::optional<Relations> relations_;
  std::vector<char> junction_;  // by vertex; empty if there are none
  std::optional<Reservations> certain_;
  std::vector<std::vector<Constraint>> certain_of_;  // by robot
};

}  // namespace mrpbench::mapf
