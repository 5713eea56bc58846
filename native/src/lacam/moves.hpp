// Where robots can go in one tick, on roadmaps on which every move takes one tick, as grids are.
#pragma once

#include <optional>

#include "mrpbench_mapf/instance.hpp"

namespace mrpbench::mapf::lacam {

class Moves {
 public:
  Moves(const Roadmap& roadmap, int profile);

  int vertex_count() const { return static_cast<int>(first_.size()) - 1; }
  std::span<const std::int32_t> successors(int vertex) const {
    return {head_.data() + first_[vertex], head_.data() + first_[vertex + 1]};
  }
  /// The edge from `tail` to one of its successors.
  int edge(int tail, int head) const;

 private:
  std::vector<std::int32_t> first_, head_, edge_;
};

/// The moves of an instance that is plain: unit durations, one motion profile, one goal each where robots stay, no
/// footprints, no commitments, all ready at tick 0, following allowed. Nothing for any other.
std::optional<Moves> unit_moves(const Instance& instance);

}  // namespace mrpbench::mapf::lacam
