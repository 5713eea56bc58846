// Where each robot can go from a vertex.
#pragma once

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/instance.hpp"

namespace mrpbench::mapf::lacam {

class Moves {
 public:
  Moves(const Instance& instance, Limits& limits);

  int vertex_count() const { return vertex_count_; }
  /// The most successors that any vertex has for any robot.
  int most_successors() const;
  std::span<const std::int32_t> successors(int robot, int vertex) const {
    const Rows& rows = rows_[rows_of_[robot]];
    return {rows.head.data() + rows.first[vertex], rows.head.data() + rows.first[vertex + 1]};
  }
  /// The edge that a robot takes from `tail` to one of its successors: the fastest.
  int edge(int robot, int tail, int head) const;

 private:
  struct Rows {
    std::vector<std::int32_t> first, head, edge;
  };
  void gather(const Roadmap& roadmap, int profile, Limits& limits);

  int vertex_count_;
  std::vector<Rows> rows_;             // of each motion profile in use
  std::vector<std::int32_t> rows_of_;  // by robot
};

}  // namespace mrpbench::mapf::lacam
