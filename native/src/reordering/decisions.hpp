// Pairs of alternative arcs between two robots that can only be decided alike.
//
// Jiang, Lin and Li, "Speedup techniques for switchable temporal plan graph optimization" (IGSES), AAAI 2025. In a
// corridor, for example, the robot that enters first also leaves first, so its pairs are one decision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_mapf/reordering/alternative_graph.hpp"

namespace mrpbench::mapf {

/// Which robot of a decision passes first: the one with the lower index (0) or the other one (1).
using Side = std::int8_t;

/// One of the two values of a decision.
struct Choice {
  std::int32_t decision;
  Side side;

  Choice other() const { return {decision, static_cast<Side>(1 - side)}; }
  /// Among the choices of all decisions.
  std::size_t index() const { return 2 * static_cast<std::size_t>(decision) + side; }
};

class Decisions {
 public:
  explicit Decisions(const AlternativeGraph& graph);

  /// The arcs that hold with a choice.
  std::span<const Arc> arcs(Choice choice) const { return part(arcs_, arc_begin_, choice.index()); }
  /// Decisions that must have the same side as `choice`, because the other side and `choice` form a cycle.
  std::span<const std::int32_t> implied(Choice choice) const { return part(implied_, implied_begin_, choice.index()); }
  int count() const { return count_; }
  /// The choice with which the planned arc of a pair holds.
  Choice planned(std::size_t pair) const { return planned_[pair]; }
  /// By decision: the side of the plan.
  std::vector<Side> planned_sides() const;

 private:
  template <class T>
  static std::span<const T> part(const std::vector<T>& all, const std::vector<std::int32_t>& begin, std::size_t index) {
    return {all.data() + begin[index], all.data() + begin[index + 1]};
  }
  struct Pair {
    std::int32_t index;
    std::array<Arc, 2> arc;  // by side
  };
  void group(std::span<const Pair> pairs, std::vector<std::array<std::int32_t, 2>>& implications);

  int count_ = 0;
  std::vector<Choice> planned_;  // by pair
  std::vector<Arc> arcs_;
  std::vector<std::int32_t> arc_begin_, implied_, implied_begin_;
};

}  // namespace mrpbench::mapf
