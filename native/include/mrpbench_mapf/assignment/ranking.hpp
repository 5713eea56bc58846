// All assignments, the cheapest first, each made only when it is asked for: the assignments that are left are split by
// the first row in which they differ from the one found last.
//   Murty, "An algorithm for ranking all the assignments in order of increasing cost", Operations Research 1968.
//   Lawler, "A procedure for computing the K best solutions to discrete optimization problems and its application to
//     the shortest path problem", Management Science 1972.
// A part inherits prices and is solved only once its bound is the least of all: Miller, Stone and Cox, "Optimizing
// Murty's ranked assignment method", IEEE Transactions on Aerospace and Electronic Systems 1997.
#pragma once

#include <optional>

#include "mrpbench_mapf/assignment/hungarian.hpp"
#include "mrpbench_mapf/common/arena.hpp"

namespace mrpbench::mapf {

class Ranking {
 public:
  /// `cost` by row and column, kForever = forbidden; all rows equally long.
  Ranking(std::vector<std::vector<Tick>> cost, Limits& limits);

  struct Ranked {
    Cost cost;
    std::vector<std::int32_t> column_of;  // by row
  };
  /// The next one, nothing when there are no more.
  std::optional<Ranked> next();

 private:
  /// Columns that the row of a part must not take.
  struct Forbidden {
    std::int32_t column;
    const Forbidden* next;
  };
  /// An `Assignment` in arenas, for there may be hundreds of thousands.
  struct Kept {
    std::span<const std::int32_t> column_of, row_of;
    std::span<const Cost> row_price, column_price;
    Cost idle_price;
  };
  /// The assignments that agree with `cheapest` in the rows below `first`, and give row `first` none of the forbidden
  /// columns. `cheapest` is one of them if the part is solved, else it belongs to the part from which this was split.
  struct Part {
    Cost bound;
    std::int64_t number;  // order of making
    bool solved;
    std::int32_t first;
    const Forbidden* forbidden;
    const Kept* cheapest;
    bool operator>(const Part& other) const {
      if (bound != other.bound) return bound > other.bound;
      if (solved != other.solved) return other.solved;
      return number > other.number;
    }
  };

  void push(Part part);
  const Kept* keep(const Assignment& it);
  void solve(const Part& part);
  void split(const Part& part);
  const std::vector<Tick>& row_of(const Part& part);
  Cost extra(const Part& part);
  Cost sum(const Assignment& it) const;

  const std::vector<std::vector<Tick>> cost_;
  Limits& limits_;
  Hungarian hungarian_;
  std::vector<const Tick*> rows_;
  std::vector<Part> parts_;  // a heap
  Arena<std::int32_t> indices_;
  Arena<Cost> prices_;
  Arena<Kept> kept_;
  Arena<Forbidden> forbidden_;
  std::int64_t number_ = 0;
  std::size_t counted_ = 0;
  std::vector<Tick> row_;
  Assignment scratch_;
};

}  // namespace mrpbench::mapf
