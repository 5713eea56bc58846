// The inflation layer: costs that decrease with the distance from what is lethal.
#include <algorithm>
#include <cstring>

#include "mrpbench_common/wide.hpp"
#include "mrpbench_local/costmap/costmap.hpp"
#include "mrpbench_local/costmap/update_buffers.hpp"

namespace mrpbench::local {

namespace {

/// Costs that are compared at once.
constexpr std::size_t kBlock = 32;
using Block = std::uint8_t __attribute__((vector_size(kBlock)));

inline void raise_block(std::uint8_t* to, const Block& other) {
  Block cost;
  std::memcpy(&cost, to, kBlock);
  cost = cost > other ? cost : other;
  std::memcpy(to, &cost, kBlock);
}

/// Raise each of `count` costs, whole blocks, to another.
inline void raise(std::uint8_t* to, const std::uint8_t* from, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kBlock) {
    Block other;
    std::memcpy(&other, from + i, kBlock);
    raise_block(to + i, other);
  }
}

/// Raise `count` costs to the same one. A whole block after them is read and written as it is.
inline void raise(std::uint8_t* to, std::uint8_t cost, std::size_t count) {
  const Block other = Block{} + cost;
  Block number;
  for (std::size_t i = 0; i < kBlock; ++i) number[i] = static_cast<std::uint8_t>(i);
  std::size_t i = 0;
  for (; i + kBlock <= count; i += kBlock) raise_block(to + i, other);
  raise_block(to + i, number < Block{} + static_cast<std::uint8_t>(count - i) ? other : Block{});
}

}  // namespace

std::uint8_t inflated_cost(double distance, double inscribed, double cost_scaling_factor) {
  if (distance == 0) return kLethal;
  if (distance <= inscribed) return kInscribed;
  return static_cast<std::uint8_t>(252 * std::exp(-cost_scaling_factor * (distance - inscribed)));
}

void Costmap::draw_stamp() {
  reach_ = static_cast<int>(std::floor(options_.inflation_radius / options_.resolution));
  const auto side = static_cast<std::size_t>(2 * reach_ + 1);
  stamp_width_ = (side + kBlock - 1) / kBlock * kBlock;
  stamp_.assign(side * stamp_width_, kFree);
  for (int y = -reach_; y <= reach_; ++y) {
    for (int x = -reach_; x <= reach_; ++x) {
      if (x * x + y * y > reach_ * reach_) continue;
      const double distance = std::sqrt(x * x + y * y) * options_.resolution;
      stamp_[static_cast<std::size_t>(y + reach_) * stamp_width_ + static_cast<std::size_t>(x + reach_)] =
          inflated_cost(distance, inscribed_, options_.cost_scaling_factor);
    }
  }
}

/// Write the costs around the lethal cells. Along a run of these, costs are those of the nearest one: at its sides the
/// costs beside one cell, beyond its ends those around the last one. The lethal cell that is nearest to a free one has
/// a free side, so cells without a free side can be skipped.
MRPBENCH_WIDE void Costmap::inflate() {
  const auto width = static_cast<std::size_t>(frame_.width), height = static_cast<std::size_t>(frame_.height);
  const auto reach = static_cast<std::size_t>(reach_), stride = width + 2 * reach + kBlock, side = 2 * reach + 1;
  std::vector<std::uint8_t>& margined = UpdateBuffers::of_thread().margined;
  CellSet& alone = UpdateBuffers::of_thread().alone;
  margined.assign(stride * (height + 2 * reach), kFree);
  alone.begin(frame_);
  // `row` of the stamp of a cell, or that row `below` it.
  const auto stamp = [&](std::size_t x, std::size_t y, std::size_t row, std::size_t below = 0) {
    raise(&margined[(y + row + below) * stride + x], &stamp_[row * stamp_width_], stamp_width_);
  };
  const auto lethal = [&](int x, int y) { return lethal_.holds({x, y}); };
  const auto buried = [&](int x, int y) {
    return (x == 0 || lethal(x - 1, y)) && (x + 1 == frame_.width || lethal(x + 1, y)) &&
           (y == 0 || lethal(x, y - 1)) && (y + 1 == frame_.height || lethal(x, y + 1));
  };
  for (int row_of = 0; row_of < frame_.height; ++row_of) {
    const auto y = static_cast<std::size_t>(row_of);
    for (int left = 0, end = 0; (left = lethal_.next_in(end, row_of)) < frame_.width;) {
      end = lethal_.next_out(left, row_of);
      while (left < end && buried(left, row_of)) ++left;
      if (left == end) continue;
      int right = end - 1;
      while (buried(right, row_of)) --right;
      if (right - left < 2) {
        for (int x = left; x <= right; ++x) alone.insert({x, row_of});
        continue;
      }
      const auto first = static_cast<std::size_t>(left), last = static_cast<std::size_t>(right);
      for (std::size_t row = 0; row < side; ++row) {
        stamp(first, y, row);
        stamp(last, y, row);
        raise(&margined[(y + row) * stride + reach + first], stamp_[row * stamp_width_ + reach], last - first);
      }
    }
  }
  alone.each([&](Cell c) {
    if (c.y > 0 && alone.holds({c.x, c.y - 1})) return;  // the run began below
    int end = c.y + 1;                                   // of the run along the column
    while (end < frame_.height && alone.holds({c.x, end})) ++end;
    const auto x = static_cast<std::size_t>(c.x), y = static_cast<std::size_t>(c.y);
    const auto more = static_cast<std::size_t>(end - 1 - c.y);
    for (std::size_t row = 0; row < reach; ++row) stamp(x, y, row);
    for (std::size_t below = 0; below <= more; ++below) stamp(x, y, reach, below);
    for (std::size_t row = reach + 1; row < side; ++row) stamp(x, y, row, more);
  });
  for (std::size_t y = 0; y < height; ++y) {
    std::memcpy(&cost_[y * width], &margined[(y + reach) * stride + reach], width);
  }
}

}  // namespace mrpbench::local
