#include "guidance.hpp"

#include <algorithm>
#include <cmath>

namespace mrpbench::discrete {
namespace {

constexpr float kFading = 0.99F;
///< Per step.
constexpr float kOpposite = 10, kStay = 2;
///< What one opposite move, or one robot that stays, in each step adds to the cost of a move of 1.
constexpr float kMost = 25;
constexpr int kPeriod = 20;
///< Steps between two changes of costs, at least.
constexpr std::size_t kCells = 10'000, kCellsOfSmall = 60'000;
///< Of tables that are computed again in a step: about one and six milliseconds.
constexpr int kSmall = 5'000;
///< Free cells of a map on which costs follow the traffic within some steps.

}  // namespace

Guidance::Guidance(const Grid& grid, DistanceTables& tables)
    : grid_(grid), tables_(tables), moves_(4 * static_cast<std::size_t>(grid.size()), 0), stays_(grid.size(), 0) {
  tables_.set_costs(costs());
}

void Guidance::observe(const std::vector<Pose>& pose, const std::vector<Action>& action) {
  for (float& it : moves_) it *= kFading;
  for (float& it : stays_) it *= kFading;
  steps_ = steps_ * kFading + 1;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    if (action[i] == Action::forward)
      ++moves_[4 * static_cast<std::size_t>(pose[i].cell) + pose[i].heading];
    else
      ++stays_[pose[i].cell];
  }
  ++age_;
}

void Guidance::update() {
  if (!tables_.refresh(grid_.size() < kSmall ? kCellsOfSmall : kCells) || age_ < kPeriod) return;
  age_ = 0;
  tables_.set_costs(costs());
}

Costs Guidance::costs() const {
  Costs found{Costs::most_turn, std::vector<std::uint8_t>(moves_.size(), 1)};
  const float steps = std::max(steps_, 1.0F);
  for (int cell = 0; cell < grid_.size(); ++cell) {
    for (int heading = 0; heading < 4; ++heading) {
      const int to = grid_.ahead(cell, heading);
      if (to < 0) continue;
      const float opposite = moves_[4 * static_cast<std::size_t>(to) + ((heading + 2) & 3)] / steps;
      const float cost = 1 + kOpposite * opposite + kStay * stays_[to] / steps;
      found.forward[4 * static_cast<std::size_t>(cell) + heading] =
          static_cast<std::uint8_t>(std::lround(static_cast<float>(found.turn) * std::min(cost, kMost)));
    }
  }
  return found;
}

}  // namespace mrpbench::discrete
