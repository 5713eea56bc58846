// Costs from every pose to a cell, computed when they are asked for and kept within a budget.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <unordered_map>
#include <vector>

#include "mrpbench_discrete/cluster_graph.hpp"
#include "mrpbench_discrete/grid.hpp"

namespace mrpbench::discrete {

/// The cost from each pose to one goal, in which any heading is accepted. A turn costs `Costs::turn`, so that the cost
/// of a pose is at most two turns above that of its cell's best heading: both are packed into one word.
class DistanceTable {
 public:
  static constexpr std::uint32_t unreachable = ClusterGraph::unreachable;

  /// The least cost over all headings.
  std::uint32_t from(int cell) const { return word(cell) >> 12; }
  std::uint32_t from(const Pose& pose) const {
    const std::uint32_t it = word(pose.cell);
    return (it >> 12) + ((it >> (3 * pose.heading)) & 7);
  }

 private:
  friend class DistanceTables;
  std::uint32_t word(int cell) const { return clusters_ ? clusters_->word(cell) : whole_[cell]; }

  std::vector<std::uint32_t> whole_;
  std::unique_ptr<ClusterTable> clusters_;
};

/// What a turn, and a move from each pose, costs.
struct Costs {
  static constexpr std::uint32_t most_turn = 3;

  std::uint32_t turn = 1;
  ///< At most `most_turn`.
  std::vector<std::uint8_t> forward;
  ///< By 4 * cell + heading; at least 1. Empty: 1 everywhere.
};

class Landmarks;

/// Tables by goal. Values do not depend on the budget: a table that was dropped is computed again with the costs that
/// it had.
class DistanceTables {
 public:
  /// Keeps at most so many bytes of tables, and at least one table; those that were used least recently are dropped.
  /// `clustered`: tables hold costs by clusters of cells (`ClusterGraph`), for maps on which whole ones take too long.
  DistanceTables(const Grid& grid, std::size_t bytes, bool clustered = false);
  ~DistanceTables();

  /// The table of a goal; the reference is valid until the next call of anything but `turn` and `forward`.
  const DistanceTable& to(int goal);
  /// The cost from a pose to a goal; of clustered tables a lower bound, for which no table is computed.
  std::uint32_t estimate(const Pose& from, int goal);
  /// Whether another table is kept only in the place of one that there is.
  bool full() const { return order_.size() >= room_; }
  bool clustered() const { return graph_ != nullptr; }
  /// Replace the costs. Goals that were asked for since the last call keep the costs that they have until `refresh`
  /// reaches them. Throws std::invalid_argument if a turn costs too much, or tables are clustered.
  void set_costs(Costs costs);
  /// Let goals follow the costs, in the order in which they were asked for: so many cells of tables, and what former
  /// calls have left of theirs. Returns whether none is left.
  bool refresh(std::size_t cells);
  std::uint32_t turn() const { return costs_.turn; }
  std::uint32_t forward(const Pose& pose) const {
    return costs_.forward.empty() ? 1 : costs_.forward[4 * static_cast<std::size_t>(pose.cell) + pose.heading];
  }

 private:
  /// A goal that was asked for. `version`: of its costs. `asked`: the version at the last time.
  struct Goal {
    std::uint64_t version = 0, asked = 0;
    std::unique_ptr<DistanceTable> table;
    std::list<int>::iterator used{};
  };

  void compute(int goal, Goal& entry);
  void drop(Goal& entry);
  std::vector<std::uint32_t> computed(int goal, const Costs& costs);

  const Grid& grid_;
  std::unique_ptr<ClusterGraph> graph_;
  std::unique_ptr<Landmarks> landmarks_;
  std::size_t room_;
  Costs costs_, former_costs_;
  std::uint64_t version_ = 0;
  std::unordered_map<int, Goal> goals_;
  std::vector<Goal*> of_cell_;
  std::list<int> order_;
  ///< Goals with tables, the last used one first.
  std::vector<std::int32_t> asked_, outdated_;
  std::size_t credit_ = 0;
  std::vector<std::uint32_t> cost_;
  std::vector<std::vector<std::int32_t>> buckets_;
};

}  // namespace mrpbench::discrete
