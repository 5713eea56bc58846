#include "mrpbench_mapf/assignment/ranking.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace mrpbench::mapf {

Ranking::Ranking(std::vector<std::vector<Tick>> cost, Limits& limits)
    : cost_(std::move(cost)), limits_(limits), hungarian_(limits) {
  for (const std::vector<Tick>& row : cost_) rows_.push_back(row.data());
  const int columns = cost_.empty() ? 0 : static_cast<int>(cost_[0].size());
  limits.charge(cost_.size() * columns * sizeof(Tick));
  auto cheapest = std::make_shared<Assignment>();
  if (!hungarian_.solve(rows_, columns, *cheapest)) return;
  push({sum(*cheapest), 0, true, 0, cost_.empty() ? std::vector<Tick>() : cost_[0], cheapest});
}

std::optional<Ranking::Ranked> Ranking::next() {
  while (!parts_.empty()) {
    std::ranges::pop_heap(parts_, std::greater{});
    Part part = std::move(parts_.back());
    parts_.pop_back();
    if (!part.solved) {
      solve(std::move(part));
      continue;
    }
    split(part);
    return Ranked{part.bound, part.cheapest->column_of};
  }
  return std::nullopt;
}

void Ranking::push(Part part) {
  const std::size_t size = part.cheapest->column_of.size() * (sizeof(std::int32_t) + sizeof(Cost)) +
                           part.cheapest->row_of.size() * (sizeof(std::int32_t) + sizeof(Cost));
  limits_.charge(sizeof(Part) + part.row.size() * sizeof(Tick) + (part.solved ? sizeof(Assignment) + size : 0));
  part.number = number_++;
  parts_.push_back(std::move(part));
  std::ranges::push_heap(parts_, std::greater{});
}

void Ranking::solve(Part part) {
  auto cheapest = std::make_shared<Assignment>(*part.cheapest);
  rows_[part.first] = part.row.data();
  const bool found = hungarian_.repair(rows_, part.first, *cheapest, part.first);
  rows_[part.first] = cost_[part.first].data();
  if (!found) return;
  part.bound = sum(*cheapest);
  part.solved = true;
  part.cheapest = std::move(cheapest);
  push(std::move(part));
}

/// What is left of `part` without its cheapest assignment.
void Ranking::split(const Part& part) {
  const Assignment& it = *part.cheapest;
  for (int row = part.first; row < static_cast<int>(rows_.size()); ++row) {
    Part rest{0, 0, false, row, row == part.first ? part.row : cost_[row], part.cheapest};
    rest.row[it.column_of[row]] = kForever;
    const Cost more = extra(rest, it);
    if (more == std::numeric_limits<Cost>::max()) continue;
    rest.bound = part.bound + more;
    push(std::move(rest));
  }
}

/// By how much `part` costs at least more than its parent `it`: its row needs another column, and the column it leaves
/// goes to a later row, or to none. No less than the least reduced costs of these two.
Cost Ranking::extra(const Part& part, const Assignment& it) const {
  constexpr Cost kNever = std::numeric_limits<Cost>::max();
  limits_.check();
  const std::int32_t left = it.column_of[part.first];
  Cost entry = kNever;
  for (std::size_t column = 0; column < part.row.size(); ++column) {
    const std::int32_t owner = it.row_of[column];
    if (part.row[column] == kForever || (owner >= 0 && owner < part.first)) continue;
    entry = std::min(entry, part.row[column] - it.row_price[part.first] - it.column_price[column]);
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
