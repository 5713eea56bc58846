// An open list with a focal list inside, for small integer costs: nodes within the bound are ordered by (row, column),
// the others wait in lists by f. All lists are linked through the nodes, so that moving a node takes constant time.
// Pearl and Kim, "Studies in semi-admissible heuristics", IEEE PAMI 1982, with buckets instead of heaps.
#pragma once

#include <bit>
#include <vector>

#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

class FocalQueue {
 public:
  static constexpr std::size_t kNodeBytes = 20;  // that the queue keeps for every node

  /// Empty, with all f at least `least_f`, and nodes up to `bound` in the focal list.
  void reset(Tick least_f, Tick bound);

  /// `node` = 0, 1, 2, ...; `f` must not be less than `least_f` has been. `row` and `column` order the focal list.
  void push(std::int32_t node, Tick f, int row, int column);
  /// Change the place of an open node in the focal list.
  void update(std::int32_t node, int row, int column);
  /// Take out the first of the focal list, which must not be empty.
  std::int32_t pop();

  bool empty() const { return size_ == 0; }
  /// Least f of the open nodes; the queue must not be empty.
  Tick least_f();
  Tick bound() const { return bound_; }
  /// Let all nodes with f <= bound into the focal list.
  void raise(Tick bound);

 private:
  static constexpr std::int32_t kNone = -1;
  static constexpr int kRows = 256;  // greater ones share the last
  struct Link {
    Tick f;
    std::int32_t row, column;
    std::int32_t previous, next;
  };
  struct Row {
    std::vector<std::int32_t> head;  // by column
    std::vector<std::uint64_t> mask;
    std::size_t first = 0;  // words of `mask` before this one are zero
  };
  void enter(std::int32_t node);
  void leave(std::int32_t node);

  static_assert(sizeof(Link) == kNodeBytes);

  std::vector<Link> links_;
  std::vector<Row> rows_ = std::vector<Row>(kRows);
  int first_row_ = kRows, used_rows_ = 0;
  std::vector<std::int32_t> far_;    // by f - base_: head of the nodes beyond the bound
  std::vector<std::int32_t> count_;  // by f - base_: open nodes
  Tick base_ = 0, least_ = 0, bound_ = 0;
  std::size_t size_ = 0;
};

}  // namespace mrpbench::mapf
