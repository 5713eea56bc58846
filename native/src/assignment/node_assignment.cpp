#include "mrpbench_mapf/assignment/node_assignment.hpp"

#include <algorithm>

namespace mrpbench::mapf {

NodeAssignment::NodeAssignment(Candidates candidates, Limits& limits)
    : candidates_(std::move(candidates)),
      hungarian_(limits),
      rows_(limits),
      row_lists_(limits),
      prices_(limits),
      records_(limits) {
  column_.assign(candidates_.goal.empty() ? 0 : candidates_.goal.back() + 1, -1);
  limits.charge(column_.size() * sizeof(std::int32_t));
  for (std::size_t column = 0; column < candidates_.goal.size(); ++column) {
    column_[candidates_.goal[column]] = static_cast<std::int32_t>(column);
  }
  for (const std::vector<Tick>& row : candidates_.cost) cost_.push_back(row.data());
}

bool NodeAssignment::solve() {
  return hungarian_.solve(cost_, static_cast<int>(candidates_.goal.size()), present_);
}

Cost NodeAssignment::sum() const {
  Cost sum = 0;
  for (int robot = 0; robot < static_cast<int>(cost_.size()); ++robot) sum += bound(robot);
  return sum;
}

bool NodeAssignment::raise(int robot, Tick cost) {
  row_.assign(cost_[robot], cost_[robot] + candidates_.goal.size());
  row_[present_.column_of[robot]] = cost;
  cost_[robot] = rows_.copy(row_).data();
  ++changes_;
  return hungarian_.repair(cost_, robot, present_);
}

const NodeAssignment::Record* NodeAssignment::keep() {
  return &records_.copy({row_lists_.copy(cost_), prices_.copy(present_.row_price), prices_.copy(present_.column_price),
                         present_.idle_price});
}

void NodeAssignment::copy(const Record& record) {
  cost_.assign(record.cost.begin(), record.cost.end());
  present_.row_price.assign(record.row_price.begin(), record.row_price.end());
  present_.column_price.assign(record.column_price.begin(), record.column_price.end());
  present_.idle_price = record.idle_price;
  std::ranges::fill(present_.row_of, -1);
}

void NodeAssignment::send(int robot, int goal) {
  present_.column_of[robot] = column_[goal];
  present_.row_of[column_[goal]] = robot;
}

}  // namespace mrpbench::mapf
