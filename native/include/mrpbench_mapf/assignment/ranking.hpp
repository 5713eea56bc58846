// All assignments, the cheapest first, each made only when it is asked for: the assignments that are left are split by
// the first row in which they differ from the one found last.
//   Murty, "An algorithm for ranking all the assignments in order of increasing cost", Operations Research 1968.
//   Lawler, "A procedure for computing the K best solutions to discrete optimization problems and its application to
//     the shortest path problem", Management Science 1972.
// A part inherits prices and is solved only once its bound is the least of all: Miller, Stone and Cox, "Optimizing
// Murty's ranked assignment method", IEEE Transactions on Aerospace and Electronic Systems 1997.
#pragma once

#include <memory>
#include <optional>

#include "mrpbench_mapf/assignment/hungarian.hpp"

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
  /// The assignments that agree with `parent` in the rows below `first`, and give row `first` another column than any
  /// assignment before.
  struct Part {
    Cost bound;
    std::int64_t number;  // order of making
    bool solved;
    int first;
    std::vector<Tick> row;                       // costs of row `first`
    std::shared_ptr<const Assignment> cheapest;  // if solved, else the parent's
    bool operator>(const Part& other) const {
      if (bound != other.bound) return bound > other.bound;
      if (solved != other.solved) return other.solved;
      return number > other.number;
    }
  };

  void push(Part part);
  void solve(Part part);
  void split(const Part& part);
  Cost extra(const Part& part, const Assignment& it) const;
  Cost sum(const Assignment& it) const;

  const std::vector<std::vector<Tick>> cost_;
  Limits& limits_;
  Hungarian hungarian_;
  std::vector<const Tick*> rows_;
  std::vector<Part> parts_;  // a heap
  std::int64_t number_ = 0;
};

}  // namespace mrpbench::mapf
