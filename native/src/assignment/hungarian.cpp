#include "mrpbench_mapf/assignment/hungarian.hpp"

#include <algorithm>

namespace mrpbench::mapf {

template <class Entry>
bool BasicHungarian<Entry>::solve(CostRows cost, int columns, Assignment& found) {
  found.column_of.assign(cost.size(), -1);
  found.row_of.assign(columns, -1);
  found.row_price.assign(cost.size(), 0);
  found.column_price.assign(columns, 0);
  found.idle_price = 0;
  for (int row = 0; row < static_cast<int>(cost.size()); ++row) {
    if (!augment(cost, row, kAny, 0, found)) return false;
  }
  return true;
}

template <class Entry>
bool BasicHungarian<Entry>::repair(CostRows cost, int row, Assignment& present, int first) {
  const int hole = present.column_of[row];
  present.row_of[hole] = -1;
  return augment(cost, row, hole, first, present);
}

/// Assign `row` along the shortest path by reduced costs to `hole`, or to any idle column.
template <class Entry>
bool BasicHungarian<Entry>::augment(CostRows cost, int row, int hole, int first, Assignment& it) {
  begin(first, it);
  scan(cost[row], it.row_price[row], kAny, 0, it);
  while (true) {
    limits_.check();
    const std::int32_t column = settle();
    if (column == kAny) return false;
    const Sum distance = distance_[column];
    const std::int32_t owner = it.row_of[column];
    if (owner < 0 && (hole == kAny || column == hole)) {
      it.row_price[row] += distance;
      change_prices(distance, it);
      move_along(row, column, it);
      return true;
    }
    settled_.push_back(column);
    if (owner < 0) {
      scan_idle(column, distance, it);
    } else {
      scan(cost[owner], it.row_price[owner], column, distance, it);
    }
  }
}

template <class Entry>
void BasicHungarian<Entry>::begin(int first, const Assignment& it) {
  const auto columns = static_cast<std::int32_t>(it.row_of.size());
  distance_.assign(columns, kFar);
  from_.assign(columns, kAny);
  settled_.clear();
  ahead_.clear();
  for (std::int32_t column = 0; column < columns; ++column) {
    if (it.row_of[column] < 0 || it.row_of[column] >= first) ahead_.push_back(column);
  }
  idle_scanned_ = false;
}

/// Take out the nearest column that can be reached, kAny if there is none.
template <class Entry>
std::int32_t BasicHungarian<Entry>::settle() {
  const auto nearest = std::ranges::min_element(ahead_, {}, [&](std::int32_t column) { return distance_[column]; });
  if (nearest == ahead_.end() || distance_[*nearest] == kFar) return kAny;
  const std::int32_t column = *nearest;
  *nearest = ahead_.back();
  ahead_.pop_back();
  return column;
}

template <class Entry>
void BasicHungarian<Entry>::scan(const Entry* cost, Sum row_price, int from, Sum distance, const Assignment& it) {
  for (const std::int32_t column : ahead_) {
    if (cost[column] < CostTraits<Entry>::kForbidden)
      reach(column, from, distance + cost[column] - row_price - it.column_price[column]);
  }
}

/// All idle rows are alike: the first one that is reached stands for all.
template <class Entry>
void BasicHungarian<Entry>::scan_idle(int from, Sum distance, const Assignment& it) {
  if (idle_scanned_) return;
  idle_scanned_ = true;
  for (const std::int32_t column : ahead_) reach(column, from, distance - it.idle_price - it.column_price[column]);
}

template <class Entry>
void BasicHungarian<Entry>::reach(int column, int from, Sum distance) {
  if (distance >= distance_[column]) return;
  distance_[column] = distance;
  from_[column] = from;
}

template <class Entry>
void BasicHungarian<Entry>::change_prices(Sum length, Assignment& it) const {
  Sum idle_change = 0;
  for (const std::int32_t column : settled_) {
    const Sum change = length - distance_[column];
    it.column_price[column] -= change;
    if (it.row_of[column] < 0) {
      idle_change = change;
    } else {
      it.row_price[it.row_of[column]] += change;
    }
  }
  it.idle_price += idle_change;
}

/// Every row on the path takes the next column, `row` the first.
template <class Entry>
void BasicHungarian<Entry>::move_along(int row, std::int32_t column, Assignment& it) const {
  while (column != kAny) {
    const std::int32_t before = from_[column];
    const std::int32_t moved = before == kAny ? row : it.row_of[before];
    it.row_of[column] = moved;
    if (moved >= 0) it.column_of[moved] = column;
    column = before;
  }
}

template class BasicHungarian<Tick>;
template class BasicHungarian<double>;

}  // namespace mrpbench::mapf
