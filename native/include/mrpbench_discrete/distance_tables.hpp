// Costs from every pose to a cell, computed once per goal and kept while there is room.
#pragma once

#include <cstdint>
#include <list>
#include <unordered_map>
#include <vector>

#include "mrpbench_discrete/grid.hpp"

namespace mrpbench::discrete {

/// The cost from each pose to one goal, in which any heading is accepted. A turn costs `Costs::turn`, so that the cost
/// of a pose is at most two turns above that of its cell's best heading: both are packed into one word.
class DistanceTable {
 public:
  static constexpr std::uint32_t unreachable = (1u << 20) - 1;

  /// The least cost over all headings.
  std::uint32_t from(int cell) const { return packed_[cell] >> 12; }
  std::uint32_t from(const Pose& pose) const {
    const std::uint32_t word = packed_[pose.cell];
    return (word >> 12) + ((word >> (3 * pose.heading)) & 7);
  }

 private:
  friend class DistanceTables;
  std::vector<std::uint32_t> packed_;
  std::uint64_t version_ = 0;
};

/// What a turn, and a move from each pose, costs.
struct Costs {
  static constexpr std::uint32_t most_turn = 3;

  std::uint32_t turn = 1;
  ///< At most `most_turn`.
  std::vector<std::uint8_t> forward;
  ///< By 4 * cell + heading; at least 1. Empty: 1 everywhere.
};

class DistanceTables {
 public:
  /// Keeps at most so many bytes of tables.
  DistanceTables(const Grid& grid, std::size_t bytes);

  /// The table of a goal; the reference is valid until `forget`, `refresh` or `set_costs`.
  const DistanceTable& to(int goal);
  /// Replace the costs, which must leave `turn` as it is once there are tables. Tables keep the costs with which they
  /// were computed until they are refreshed. Throws std::invalid_argument if a turn costs too much.
  void set_costs(Costs costs);
  /// Compute tables of former costs again: so many cells of them, and what former calls have left of theirs. Returns
  /// whether none is left.
  bool refresh(std::size_t cells);
  /// Drop the tables that were used least recently, until there is room. Call it where no reference is held.
  void forget();
  std::uint32_t turn() const { return costs_.turn; }
  std::uint32_t forward(const Pose& pose) const {
    return costs_.forward.empty() ? 1 : costs_.forward[4 * static_cast<std::size_t>(pose.cell) + pose.heading];
  }

 private:
  DistanceTable computed(int goal);

  const Grid& grid_;
  std::size_t room_;
  Costs costs_;
  std::uint64_t version_ = 0;
  struct Kept {
    DistanceTable table;
    std::list<int>::iterator used;
  };
  std::vector<Kept*> of_goal_;
  std::unordered_map<int, Kept> tables_;
  std::list<int> order_;
  std::vector<std::int32_t> outdated_;
  std::size_t credit_ = 0;
  std::vector<std::uint32_t> cost_;
  std::vector<std::vector<std::int32_t>> buckets_;
};

}  // namespace mrpbench::discrete
