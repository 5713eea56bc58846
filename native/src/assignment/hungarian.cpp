#include "mrpbench_mapf/assignment/hungarian.hpp"

#include <algorithm>
#include <numeric>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::mapf {

namespace {

constexpr std::int32_t kBlock = 64;  // columns that are passed over at once if none gets nearer
constexpr int kRounds = 2;           // of row reduction
constexpr int kLanes = 8;            // minima of a row are kept apart, which lets compilers use vectors

/// `base` plus the reduced cost of a pair, or kFar if the pair is forbidden.
template <class Entry, class Sum = typename CostTraits<Entry>::Sum>
Sum reduced(Entry cost, Sum price, Sum base = 0) {
  if constexpr (std::numeric_limits<Entry>::has_infinity) {
    return base + (cost - price);
  } else {
    return cost < CostTraits<Entry>::kForbidden ? base + (cost - price) : CostTraits<Entry>::kFar;
  }
}

/// The two least of the reduced costs of a row.
template <class Sum>
struct Least {
  Sum first, second;
};

template <class Entry, class Sum = typename CostTraits<Entry>::Sum>
MRPBENCH_WIDE Least<Sum> least_two(const Entry* __restrict cost, const Sum* __restrict price, int columns) {
  Sum first[kLanes], second[kLanes];
  std::ranges::fill(first, CostTraits<Entry>::kFar);
  std::ranges::fill(second, CostTraits<Entry>::kFar);
  const auto take = [&](int column, int lane) {
    const Sum value = reduced(cost[column], price[column]);
    const Sum larger = value < first[lane] ? first[lane] : value;
    first[lane] = value < first[lane] ? value : first[lane];
    second[lane] = larger < second[lane] ? larger : second[lane];
  };
  const int whole = columns - columns % kLanes;
  for (int column = 0; column < whole; column += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) take(column + lane, lane);
  }
  for (int column = whole; column < columns; ++column) take(column, column - whole);
  Least<Sum> found{first[0], second[0]};
  for (int lane = 1; lane < kLanes; ++lane) {
    found.second = std::min({std::max(found.first, first[lane]), found.second, second[lane]});
    found.first = std::min(found.first, first[lane]);
  }
  return found;
}

/// The least of a block.
template <class Sum>
[[gnu::always_inline]] inline Sum least_of(const Sum* value) {
  Sum least[kBlock / 2];
  for (int at = 0; at < kBlock / 2; ++at) least[at] = std::min(value[at], value[at + kBlock / 2]);
  for (int half = kBlock / 4; half > 0; half /= 2) {
    for (int at = 0; at < half; ++at) least[at] = std::min(least[at], least[at + half]);
  }
  return least[0];
}

/// Shorten the distances of columns by way of a row, and keep the least of each block. Returns the least of all.
template <class Entry, class Sum = typename CostTraits<Entry>::Sum>
MRPBENCH_WIDE Sum relax(const Entry* __restrict cost, const Sum* __restrict price, Sum base, Sum from, int columns,
                        Sum* __restrict distance, Sum* __restrict via, Sum* __restrict least) {
  Sum nearest = CostTraits<Entry>::kFar;
  for (int block = 0; block < columns; block += kBlock, ++least) {
    const int end = std::min(block + kBlock, columns);
    int nearer = 0;
    for (int column = block; column < end; ++column) {
      nearer += reduced(cost[column], price[column], base) < distance[column];
    }
    if (nearer > 0) {
      for (int column = block; column < end; ++column) {
        const Sum here = reduced(cost[column], price[column], base), before = distance[column];
        via[column] = here < before ? from : via[column];
        distance[column] = here < before ? here : before;
      }
      *least = least_of(distance + block);
    }
    nearest = std::min(nearest, *least);
  }
  return nearest;
}

}  // namespace

template <class Entry>
bool BasicHungarian<Entry>::solve(CostRows cost, int columns, Assignment& found) {
  begin(cost, columns, found);
  if (static_cast<int>(cost.size()) == columns) reduce_columns(cost, found);
  std::vector<std::int32_t> open(cost.size());
  std::iota(open.begin(), open.end(), 0);
  for (int round = 0; round < kRounds; ++round) {
    if (!reduce_rows(cost, open, found)) return false;
  }
  return std::ranges::all_of(open, [&](int row) { return augment(cost, row, kAny, 0, found); });
}

template <class Entry>
void BasicHungarian<Entry>::begin(CostRows cost, int columns, Assignment& it) const {
  it.column_of.assign(cost.size(), kAny);
  it.row_of.assign(columns, kAny);
  it.row_price.assign(cost.size(), 0);
  it.column_price.assign(columns, 0);
  it.idle_price = 0;
}

/// Price every column at its least cost.
template <class Entry>
void BasicHungarian<Entry>::reduce_columns(CostRows cost, Assignment& it) {
  std::vector<Entry> least(it.row_of.size(), CostTraits<Entry>::kForbidden);
  for (const Entry* row : cost) {
    limits_.check();
    for (std::size_t column = 0; column < least.size(); ++column) least[column] = std::min(least[column], row[column]);
  }
  for (std::size_t column = 0; column < least.size(); ++column) {
    if (least[column] < CostTraits<Entry>::kForbidden) it.column_price[column] = static_cast<Sum>(least[column]);
  }
}

/// Assign the open rows to their cheapest columns, which get dearer until the row has a second choice. A row that loses
/// its column to another takes its turn at once. `open` keeps the rows without a column. False if a row cannot have
/// any.
template <class Entry>
bool BasicHungarian<Entry>::reduce_rows(CostRows cost, std::vector<std::int32_t>& open, Assignment& it) {
  std::vector<std::int32_t> left;
  std::size_t displacements = 2 * cost.size();  // prices may rise in steps that are too small to end
  for (std::int32_t row : open) {
    while (row != kAny) {
      limits_.check();
      const Least<Sum> least = least_two(cost[row], it.column_price.data(), static_cast<int>(it.row_of.size()));
      if (least.first == kFar) return false;
      const bool dearer = least.first < least.second && least.second < kFar;
      const std::int32_t column = column_at(least.first, cost[row], it);
      const std::int32_t owner = it.row_of[column];
      if (owner != kAny && (!dearer || displacements == 0)) {
        left.push_back(row);
        break;
      }
      if (dearer) it.column_price[column] -= least.second - least.first;
      it.row_price[row] = dearer ? least.second : least.first;
      it.row_of[column] = row;
      it.column_of[row] = column;
      if (owner != kAny) --displacements;
      row = owner;
    }
  }
  open = std::move(left);
  return true;
}

/// A column with a reduced cost that one has, if possible without a row.
template <class Entry>
std::int32_t BasicHungarian<Entry>::column_at(Sum value, const Entry* cost, const Assignment& it) const {
  std::int32_t found = kAny;
  for (std::int32_t column = 0; column < static_cast<std::int32_t>(it.row_of.size()); ++column) {
    if (reduced(cost[column], it.column_price[column]) != value) continue;
    if (it.row_of[column] == kAny) return column;
    if (found == kAny) found = column;
  }
  return found;
}

template <class Entry>
bool BasicHungarian<Entry>::find_bottleneck(CostRows cost, int columns, Entry& greatest) {
  Assignment it;
  begin(cost, columns, it);
  greatest = std::numeric_limits<Entry>::lowest();
  for (const Entry* row : cost) greatest = std::max(greatest, *std::min_element(row, row + columns));
  for (int row = 0; row < static_cast<int>(cost.size()); ++row) {
    begin_search(0, it);
    Sum nearest = scan(cost[row], 0, kAny);  // without prices, a distance is the least cost of a pair on the way
    std::int32_t end = kAny;
    for (std::int32_t next = 0; end == kAny; ++next) {
      if (next > 0) nearest = scan(cost[it.row_of[settled_[next - 1].column]], 0, next - 1);
      if (next == static_cast<std::int32_t>(settled_.size())) {
        if (nearest == kFar) return false;
        greatest = std::max(greatest, static_cast<Entry>(nearest));
      }
      if (nearest <= greatest) end = settle(greatest, kAny, it);
    }
    move_along(row, end, it);
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
  begin_search(first, it);
  Sum nearest = scan(cost[row], -it.row_price[row], kAny);
  Sum distance = -kFar;
  bool idle_scanned = false;
  for (std::int32_t next = 0;; ++next) {
    if (next == static_cast<std::int32_t>(settled_.size())) {
      if (nearest == kFar) return false;
      distance = nearest;
    }
    if (nearest <= distance) {
      const std::int32_t end = settle(distance, hole, it);
      if (end != kAny) {
        it.row_price[row] += settled_[end].distance;
        change_prices(settled_[end].distance, it);
        move_along(row, end, it);
        return true;
      }
    }
    const std::int32_t owner = it.row_of[settled_[next].column];
    if (owner >= 0) {
      nearest = scan(cost[owner], settled_[next].distance - it.row_price[owner], next);
    } else if (!idle_scanned) {  // all idle rows are alike: the first one that is reached stands for all
      idle_scanned = true;
      const std::vector<Entry> free(it.row_of.size(), Entry{0});
      nearest = scan(free.data(), settled_[next].distance - it.idle_price, next);
    } else {
      nearest = std::ranges::min(least_);
    }
  }
}

template <class Entry>
void BasicHungarian<Entry>::begin_search(int first, const Assignment& it) {
  const std::size_t columns = it.row_of.size(), blocks = (columns + kBlock - 1) / kBlock;
  price_ = it.column_price;
  distance_.assign(blocks * kBlock, kFar);
  from_.assign(columns, kAny);
  least_.assign(blocks, kFar);
  settled_.clear();
  if (first == 0) return;
  for (std::size_t column = 0; column < columns; ++column) {
    if (it.row_of[column] >= 0 && it.row_of[column] < first) price_[column] = -2 * kFar;
  }
}

/// Shorten the distances by way of a row, whose column is settled at index `from`. Returns the least of all.
template <class Entry>
typename BasicHungarian<Entry>::Sum BasicHungarian<Entry>::scan(const Entry* cost, Sum base, std::int32_t from) {
  limits_.check();
  return relax(cost, price_.data(), base, static_cast<Sum>(from), static_cast<int>(price_.size()), distance_.data(),
               from_.data(), least_.data());
}

/// Settle all columns at a distance. Returns the index of one where the path ends, or kAny.
template <class Entry>
std::int32_t BasicHungarian<Entry>::settle(Sum distance, int hole, const Assignment& it) {
  const auto columns = static_cast<std::int32_t>(price_.size());
  for (std::int32_t block = 0; block < columns; block += kBlock) {
    Sum& least = least_[block / kBlock];
    if (least > distance) continue;
    for (std::int32_t column = block; column < std::min(block + kBlock, columns); ++column) {
      if (distance_[column] > distance) continue;
      settled_.push_back({column, static_cast<std::int32_t>(from_[column]), distance_[column]});
      if (it.row_of[column] < 0 && (hole == kAny || column == hole))
        return static_cast<std::int32_t>(settled_.size()) - 1;
      price_[column] = -2 * kFar;
      distance_[column] = kFar;
    }
    least = least_of(distance_.data() + block);
  }
  return kAny;
}

template <class Entry>
void BasicHungarian<Entry>::change_prices(Sum length, Assignment& it) const {
  Sum idle_change = 0;
  for (const Settled& settled : settled_) {
    const Sum change = length - settled.distance;
    it.column_price[settled.column] -= change;
    const std::int32_t owner = it.row_of[settled.column];
    if (owner < 0) {
      idle_change = std::max(idle_change, change);
    } else {
      it.row_price[owner] += change;
    }
  }
  it.idle_price += idle_change;
}

/// Every row on the path takes the next column, `row` the first.
template <class Entry>
void BasicHungarian<Entry>::move_along(int row, std::int32_t end, Assignment& it) const {
  while (end != kAny) {
    const auto [column, before, distance] = settled_[end];
    const std::int32_t moved = before == kAny ? row : it.row_of[settled_[before].column];
    it.row_of[column] = moved;
    if (moved >= 0) it.column_of[moved] = column;
    end = before;
  }
}

template class BasicHungarian<Tick>;
template class BasicHungarian<double>;

}  // namespace mrpbench::mapf
