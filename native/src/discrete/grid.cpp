#include "mrpbench_discrete/grid.hpp"

#include <cstdlib>
#include <stdexcept>

namespace mrpbench::discrete {

Grid::Grid(std::span<const std::uint8_t> blocked, int height, int width) : height_(height), width_(width) {
  if (height < 1 || width < 1 || blocked.size() != static_cast<std::size_t>(height) * width) {
    throw std::invalid_argument("blocked does not have height * width cells");
  }
  for (std::size_t i = 0; i < blocked.size(); ++i) {
    number_.push_back(blocked[i] ? -1 : static_cast<std::int32_t>(place_.size()));
    if (!blocked[i]) place_.push_back(static_cast<std::int32_t>(i));
  }
  for (const int place : place_) {
    const int row = place / width, column = place % width;
    ahead_.push_back({column + 1 < width ? number_[place + 1] : -1, row + 1 < height ? number_[place + width] : -1,
                      column > 0 ? number_[place - 1] : -1, row > 0 ? number_[place - width] : -1});
  }
}

int Grid::manhattan(int a, int b) const {
  const int p = place_[a], q = place_[b];
  return std::abs(p / width_ - q / width_) + std::abs(p % width_ - q % width_);
}

Pose Grid::after(const Pose& pose, Action action) const {
  switch (action) {
    case Action::forward: {
      const int next = ahead(pose);
      return {next < 0 ? pose.cell : next, pose.heading};
    }
    case Action::clockwise:
      return {pose.cell, (pose.heading + 1) & 3};
    case Action::counter_clockwise:
      return {pose.cell, (pose.heading + 3) & 3};
    default:
      return pose;
  }
}

}  // namespace mrpbench::discrete
