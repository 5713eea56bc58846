#include "mrpbench_slam/field.hpp"

namespace mrpbench::slam {

namespace {

/// Deviations beyond which a response counts as 0.
constexpr double kReach = 3;

/// Weights of three neighbouring cells, and their slopes, for a place within the middle one, from -0.5 to 0.5.
struct Spline {
  double weight[3], slope[3];

  explicit Spline(double u)
      : weight{0.5 * (0.5 - u) * (0.5 - u), 0.75 - u * u, 0.5 * (0.5 + u) * (0.5 + u)},
        slope{u - 0.5, -2 * u, u + 0.5} {}
};

}  // namespace

Field::Field(double resolution, double deviation)
    : resolution_(resolution),
      deviation_(deviation),
      per_metre_(1 / resolution),
      radius_(std::max(1, static_cast<int>(std::ceil(kReach * deviation / resolution)))) {
  for (int y = -radius_; y <= radius_; ++y) {
    for (int x = -radius_; x <= radius_; ++x) {
      const double squared = (x * x + y * y) * resolution * resolution;
      kernel_.push_back(static_cast<std::uint8_t>(std::lround(255 * std::exp(-squared / (2 * deviation * deviation)))));
    }
  }
}

void Field::raise(Cell occupied) {
  const Box around{{occupied.column - radius_, occupied.row - radius_},
                   {occupied.column + radius_ + 1, occupied.row + radius_ + 1}};
  grid_.cover(around);
  stamp(occupied, around);
}

void Field::stamp(Cell occupied, Box within) {
  const int width = 2 * radius_ + 1;
  const int left = std::max(occupied.column - radius_, within.low.column);
  const int right = std::min(occupied.column + radius_ + 1, within.high.column);
  const int bottom = std::max(occupied.row - radius_, within.low.row);
  const int top = std::min(occupied.row + radius_ + 1, within.high.row);
  for (int y = bottom; y < top; ++y) {
    const std::uint8_t* from =
        kernel_.data() + (y - occupied.row + radius_) * width + (left - occupied.column + radius_);
    std::uint8_t* to = grid_.row(y) + (left - grid_.box().low.column);
    for (int x = left; x < right; ++x, ++from, ++to) *to = std::max(*to, *from);
  }
}

Response Field::response(Point point) const {
  const double x = point.x * per_metre_, y = point.y * per_metre_;
  const Cell cell{floor_index(x), floor_index(y)};
  const Box& box = grid_.box();
  if (!(cell.column > box.low.column && cell.row > box.low.row && cell.column + 1 < box.high.column &&
        cell.row + 1 < box.high.row)) {
    return {};
  }
  const Spline across(x - cell.column - 0.5), up(y - cell.row - 0.5);
  double value = 0, by_x = 0, by_y = 0;
  for (int j = 0; j < 3; ++j) {
    const std::uint8_t* at = grid_.row(cell.row + j - 1) + (cell.column - 1 - box.low.column);
    const double sum = across.weight[0] * at[0] + across.weight[1] * at[1] + across.weight[2] * at[2];
    value += up.weight[j] * sum;
    by_x += up.weight[j] * (across.slope[0] * at[0] + across.slope[1] * at[1] + across.slope[2] * at[2]);
    by_y += up.slope[j] * sum;
  }
  return {value / 255, Point{by_x, by_y} * (per_metre_ / 255)};
}

}  // namespace mrpbench::slam
