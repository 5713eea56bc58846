#include "mrpbench_mapf/assignment/ranking.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace mrpbench::mapf {

namespace {

constexpr Cost kNever = std::numeric_limits<Cost>::max();

}  // namespace

Ranking::Ranking(std::vector<std::vector<Tick>> cost, Limits& limits)
    : cost_(std::move(cost)),
      limits_(limits),
      hungarian_(limits),
      indices_(limits),
      prices_(limits),
      kept_(limits),
      forbidden_(limits) {
  for (const std::vector<Tick>& row : cost_) rows_.push_back(row.data());
  const int columns = cost_.empty() ? 0 : static_cast<int>(cost_[0].size());
  if (!hungarian_.solve(rows_, columns, scratch_)) return;
  push({sum(scratch_), 0, true, 0, nullptr, keep(scratch_)});
}

std::optional<Ranking::Ranked> Ranking::next() {
  while (!parts_.empty()) {
    std::ranges::pop_heap(parts_, std::greater{});
    const Part part = parts_.back();
    parts_.pop_back();
    if (!part.solved) {
      solve(part);
      continue;
    }
    split(part);
    const auto columns = part.cheapest->column_of;
    return Ranked{part.bound, {columns.begin(), columns.end()}};
  }
  return std::nullopt;
}

void Ranking::push(Part part) {
  part.number = number_++;
  parts_.push_back(part);
  std::ranges::push_heap(parts_, std::greater{});
  limits_.charge_growth(counted_, parts_.capacity() * sizeof(Part));
}

const Ranking::Kept* Ranking::keep(const Assignment& it) {
  return &kept_.copy({indices_.copy(it.column_of), indices_.copy(it.row_of), prices_.copy(it.row_price),
                      prices_.copy(it.column_price), it.idle_price});
}

void Ranking::solve(const Part& part) {
  const Kept& from = *part.cheapest;
  scratch_.column_of.assign(from.column_of.begin(), from.column_of.end());
  scratch_.row_of.assign(from.row_of.begin(), from.row_of.end());
  scratch_.row_price.assign(from.row_price.begin(), from.row_price.end());
  scratch_.column_price.assign(from.column_price.begin(), from.column_price.end());
  scratch_.idle_price = from.idle_price;
  rows_[part.first] = row_of(part).data();
  const bool found = hungarian_.repair(rows_, part.first, scratch_, part.first);
  rows_[part.first] = cost_[part.first].data();
  if (found) push({sum(scratch_), 0, true, part.first, part.forbidden, keep(scratch_)});
}

/// What is left of `part` without its cheapest assignment.
void Ranking::split(const Part& part) {
  for (std::int32_t row = part.first; row < static_cast<std::int32_t>(rows_.size()); ++row) {
    const Forbidden* before = row == part.first ? part.forbidden : nullptr;
    const Forbidden& forbidden = forbidden_.copy({part.cheapest->column_of[row], before});
    Part rest{0, 0, false, row, &forbidden, part.cheapest};
    const Cost more = extra(rest);
    if (more == kNever) continue;
    rest.bound = part.bound + more;
    push(rest);
  }
}

/// The costs of row `part.first`.
const std::vector<Tick>& Ranking::row_of(const Part& part) {
  row_ = cost_[part.first];
  for (const Forbidden* it = part.forbidden; it != nullptr; it = it->next) row_[it->column] = kForever;
  return row_;
}

/// By how much a part costs at least more than what it was split from: its row needs another column, and the column it
/// leaves goes to a later row, or to none. No less than the least reduced costs of these two.
Cost Ranking::extra(const Part& part) {
  limits_.check();
  const Kept& it = *part.cheapest;
  const std::vector<Tick>& own = row_of(part);
  const std::int32_t left = it.column_of[part.first];
  Cost entry = kNever;
  for (std::size_t column = 0; column < own.size(); ++column) {
    const std::int32_t owner = it.row_of[column];
    if (own[column] == kForever || (owner >= 0 && owner < part.first)) continue;
    entry = std::min(entry, own[column] - it.row_price[part.first] - it.column_price[column]);
  }
  if (entry == kNever) return kNever;
  const bool idle = it.row_of.size() > rows_.size();
  Cost exit = idle ? -it.idle_price - it.column_price[left] : kNever;
  for (int row = part.first + 1; row < static_cast<int>(rows_.size()); ++row) {
    if (rows_[row][left] == kForever) continue;
    exit = std::min(exit, rows_[row][left] - it.row_price[row] - it.column_price[left]);
  }
  return exit == kNever ? kNever : entry + exit;
}

Cost Ranking::sum(const Assignment& it) const {
  Cost sum = 0;
  for (std::size_t row = 0; row < rows_.size(); ++row) sum += rows_[row][it.column_of[row]];
  return sum;
}

}  // namespace mrpbench::mapf
