// Where robots can go in one tick, on roadmaps on which every move takes one tick, as grids are.
#pragma once

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/instance.hpp"

namespace mrpbench::mapf::lacam {

class Moves {
 public:
  /// Those of the instance's robots, which must be `plain`.
  Moves(const Instance& instance, Limits& limits);

  int vertex_count() const { return static_cast<int>(first_.size()) - 1; }
  std::span<const std::int32_t> successors(int vertex) const {
    return {head_.data() + first_[vertex], head_.data() + first_[vertex + 1]};
  }
  /// The edge from `tail` to one of its successors.
  int edge(int tail, int head) const;

 private:
  std::vector<std::int32_t> first_, head_, edge_;
};

/// Is all there is to know that robots go where these moves lead? Unit durations, one motion profile, one goal each
/// where robots stay, no footprints, no commitments, all ready at tick 0, following allowed.
bool is_plain(const Instance& instance);
/// Throws std::invalid_argument naming the `solver` that can do nothing with an instance that is not.
void require_plain(const Instance& instance, const char* solver);

}  // namespace mrpbench::mapf::lacam
