// The cheapest assignment of rows (robots) to different columns (goals), by shortest augmenting paths, and its repair
// when the costs of a row have risen: one more augmenting path.
//   Jonker and Volgenant, "A shortest augmenting path algorithm for dense and sparse linear assignment problems",
//     Computing 1987.
//   Mills-Tettey, Stentz and Dias, "The dynamic Hungarian algorithm for the assignment problem with changing costs",
//     technical report CMU-RI-TR-07-27, 2007; here also with more columns than rows.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

/// By row, one cost per column; kForever = forbidden.
using CostRows = std::span<const Tick* const>;

/// An assignment, and prices that prove it cheapest: cost >= row_price + column_price everywhere, equal where assigned.
/// Columns without a row have the price -idle_price, the highest of all, as if idle rows had them at no cost.
struct Assignment {
  std::vector<std::int32_t> column_of;  // by row
  std::vector<std::int32_t> row_of;     // by column, -1 = idle
  std::vector<Cost> row_price, column_price;
  Cost idle_price = 0;
};

class Hungarian {
 public:
  explicit Hungarian(Limits& limits) : limits_(limits) {}

  /// The cheapest assignment of all rows, into `found`. False if there is none.
  bool solve(CostRows cost, int columns, Assignment& found);
  /// Make `present` cheapest again after costs of `row` have risen, above all that of its column. Rows below `first`
  /// keep their columns. False if there is no assignment; then `present` is none either.
  bool repair(CostRows cost, int row, Assignment& present, int first = 0);

 private:
  static constexpr int kAny = -1;
  static constexpr Cost kFar = Cost{1} << 60;
  bool augment(CostRows cost, int row, int hole, int first, Assignment& it);
  void begin(int first, const Assignment& it);
  std::int32_t settle();
  void scan(const Tick* cost, Cost row_price, int from, Cost distance, const Assignment& it);
  void scan_idle(int from, Cost distance, const Assignment& it);
  void reach(int column, int from, Cost distance);
  void change_prices(Cost length, Assignment& it) const;
  void move_along(int row, std::int32_t column, Assignment& it) const;

  Limits& limits_;
  // the current search, by column
  std::vector<Cost> distance_;
  std::vector<std::int32_t> from_;   // column whose row leads here, kAny = the row that is assigned
  std::vector<std::int32_t> ahead_;  // not settled
  std::vector<std::int32_t> settled_;
  bool idle_scanned_ = false;
};

}  // namespace mrpbench::mapf
