// The cheapest assignment of rows (robots) to different columns (goals), by shortest augmenting paths, and its repair
// when the costs of a row have risen: one more augmenting path.
//   Jonker and Volgenant, "A shortest augmenting path algorithm for dense and sparse linear assignment problems",
//     Computing 1987: column reduction and augmenting row reduction come first. As there, all columns
//     at one distance are found at once, so that a path ends as soon as it can, however many ties there are.
//   Crouse, "On implementing 2D rectangular assignment algorithms", IEEE Transactions on Aerospace and Electronic
//   Systems
//     2016: with more columns than rows, columns start without prices, since idle ones must have the highest.
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
  /// The least `greatest` such that all rows can have columns that cost no more. False if there is none.
  ///   Derigs and Zimmermann, "An augmenting path method for solving linear bottleneck assignment problems", Computing
  ///   1978.
  bool find_bottleneck(CostRows cost, int columns, Entry& greatest);

 private:
  static constexpr std::int32_t kAny = -1;
  static constexpr Sum kFar = CostTraits<Entry>::kFar;
  void begin(CostRows cost, int columns, Assignment& it) const;
  void reduce_columns(CostRows cost, Assignment& it);
  bool reduce_rows(CostRows cost, std::vector<std::int32_t>& open, Assignment& it);
  std::int32_t column_at(Sum value, const Entry* cost, const Assignment& it) const;
  bool augment(CostRows cost, int row, int hole, int first, Assignment& it);
  void begin_search(int first, const Assignment& it);
  Sum scan(const Entry* cost, Sum base, std::int32_t from);
  std::int32_t settle(Sum distance, int hole, const Assignment& it);
  void change_prices(Sum length, Assignment& it) const;
  void move_along(int row, std::int32_t column, Assignment& it) const;

  Limits& limits_;
  // the current search, by column
  std::vector<Sum> price_;     // far below all others if the column is settled or must not be taken
  std::vector<Sum> distance_;  // kFar likewise
  std::vector<Sum> from_;      // index of the settled column whose row leads here, kAny = the row that is assigned
  std::vector<Sum> least_;     // the least distance of each block of columns
  struct Settled {
    std::int32_t column;
    std::int32_t before;  // as from_
    Sum distance;
  };
  std::vector<Settled> settled_;
};

using Hungarian = BasicHungarian<Tick>;
using Assignment = Hungarian::Assignment;
using CostRows = Hungarian::CostRows;

}  // namespace mrpbench::mapf
