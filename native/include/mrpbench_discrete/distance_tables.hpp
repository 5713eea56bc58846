// Costs from every pose to a cell, computed once per goal and kept while there is room.
#pragma once

#include <cstdint>
#include <list>
#include <unordered_map>
#include <vector>

#include "mrpbench_discrete/grid.hpp"

namespace mrpbench::discrete {

/// The cost from each pose to one goal, in which any heading is accepted. A turn costs `Costs::turn`, so that the cost
/// of a pose is that of its cell's best heading plus 0, 1 or 2 turns: both are packed into one word.
class DistanceTable {
 public:
  static constexpr std::uint32_t unreachable = (1u << 24) - 1;

  /// The least cost over all headings.
  std::uint32_t from(int cell) const { return packed_[cell] >> 8; }
  std::uint32_t from(const Pose& pose) const {
    const std::uint32_t word = packed_[pose.cell];
    return (word >> 8) + ((word >> (2 * pose.heading)) & 3) * turn_;
  }

 private:
  friend class DistanceTables;
  std::vector<std::uint32_t> packed_;
  std::uint32_t turn_ = 1;
};

/// What a move from each pose costs.
struct Costs {
  std::uint32_t turn = 1;
  std::vector<std::uint8_t> forward;
  ///< By 4 * cell + heading; at least 1. Empty: 1 everywhere.
};

class DistanceTables {
 public:
  /// Keeps at most so many bytes of tables.
  DistanceTables(const Grid& grid, std::size_t bytes);

  /// The table of a goal; the reference is valid until `forget`.
  const DistanceTable& to(int goal);
  /// Replace the costs; drops all tables.
  void set_costs(Costs costs);
  /// Drop the tables that were used least recently, until there is room. Call it where no reference is held.
  void forget();
  std::uint32_t turn() const { return costs_.turn; }

 private:
  DistanceTable computed(int goal);

  const Grid& grid_;
  std::size_t room_;
  Costs costs_;
  struct Kept {
    DistanceTable table;
    std::list<int>::iterator used;
  };
  std::vector<Kept*> of_goal_;
  std::unordered_map<int, Kept> tables_;
  std::list<int> order_;
  std::vector<std::uint32_t> cost_;
  std::vector<std::vector<std::int32_t>> buckets_;
};

}  // namespace mrpbench::discrete
