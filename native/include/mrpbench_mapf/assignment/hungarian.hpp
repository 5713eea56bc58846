// The cheapest assignment of rows (robots) to different columns (goals), by shortest augmenting paths, and its repair
// when the costs of a row have risen: one more augmenting path.
//   Jonker and Volgenant, "A shortest augmenting path algorithm for dense and sparse linear assignment problems",
//     Computing 1987.
//   Mills-Tettey, Stentz and Dias, "The dynamic Hungarian algorithm for the assignment problem with changing costs",
//     technical report CMU-RI-TR-07-27, 2007; here also with more columns than rows.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

/// What costs of one pair add up to, and the cost that forbids a pair.
template <class Entry>
struct CostTraits;

template <>
struct CostTraits<Tick> {
  using Sum = Cost;
  static constexpr Tick kForbidden = kForever;
  static constexpr Sum kFar = Cost{1} << 60;
};

/// Real costs: prices prove the assignment cheapest except for rounding.
template <>
struct CostTraits<double> {
  using Sum = double;
  static constexpr double kForbidden = std::numeric_limits<double>::infinity();
  static constexpr Sum kFar = std::numeric_limits<double>::infinity();
};

/// An assignment, and prices that prove it cheapest: cost >= row_price + column_price everywhere, equal where assigned.
/// Columns without a row have the price -idle_price, the highest of all, as if idle rows had them at no cost.
template <class Sum>
struct BasicAssignment {
  std::vector<std::int32_t> column_of;  // by row
  std::vector<std::int32_t> row_of;     // by column, -1 = idle
  std::vector<Sum> row_price, column_price;
  Sum idle_price = 0;
};

template <class Entry>
class BasicHungarian {
 public:
  using Sum = typename CostTraits<Entry>::Sum;
  using Assignment = BasicAssignment<Sum>;
  /// By row, one cost per column; rows are not more than columns.
  using CostRows = std::span<const Entry* const>;

  explicit BasicHungarian(Limits& limits) : limits_(limits) {}

  /// The cheapest assignment of all rows, into `found`. False if there is none.
  bool solve(CostRows cost, int columns, Assignment& found);
  /// Make `present` cheapest again after costs of `row` have risen, above all that of its column. Rows below `first`
  /// keep their columns. False if there is no assignment; then `present` is none either.
  bool repair(CostRows cost, int row, Assignment& present, int first = 0);

 private:
  static constexpr int kAny = -1;
  static constexpr Sum kFar = CostTraits<Entry>::kFar;
  bool augment(CostRows cost, int row, int hole, int first, Assignment& it);
  void begin(int first, const Assignment& it);
  std::int32_t settle();
  void scan(const Entry* cost, Sum row_price, int from, Sum distance, const Assignment& it);
  void scan_idle(int from, Sum distance, const Assignment& it);
  void reach(int column, int from, Sum distance);
  void change_prices(Sum length, Assignment& it) const;
  void move_along(int row, std::int32_t column, Assignment& it) const;

  Limits& limits_;
  // the current search, by column
  std::vector<Sum> distance_;
  std::vector<std::int32_t> from_;   // column whose row leads here, kAny = the row that is assigned
  std::vector<std::int32_t> ahead_;  // not settled
  std::vector<std::int32_t> settled_;
  bool idle_scanned_ = false;
};

using Hungarian = BasicHungarian<Tick>;
using Assignment = Hungarian::Assignment;
using CostRows = Hungarian::CostRows;

}  // namespace mrpbench::mapf
