// The inflation layer: costs that decrease with the distance from what is lethal.
#include <algorithm>
#include <cstring>

#include "local/next_byte.hpp"
#include "mrpbench_common/wide.hpp"
#include "mrpbench_local/costmap/costmap.hpp"
#include "mrpbench_local/costmap/update_buffers.hpp"

namespace mrpbench::local {

namespace {

/// Costs that are compared at once.
constexpr std::size_t kBlock = 32;
using Block = std::uint8_t __attribute__((vector_size(kBlock)));

/// Raise each of `count` costs to another.
void raise(std::uint8_t* to, const std::uint8_t* from, std::size_t count) {
  std::size_t i = 0;
  for (; i + kBlock <= count; i += kBlock) {
    Block cost, other;
    std::memcpy(&cost, to + i, kBlock);
    std::memcpy(&other, from + i, kBlock);
    cost = cost > other ? cost : other;
    std::memcpy(to + i, &cost, kBlock);
  }
  for (; i < count; ++i) to[i] = std::max(to[i], from[i]);
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
  std::vector<std::uint8_t>&margined = UpdateBuffers::of_thread().margined, &alone = UpdateBuffers::of_thread().alone;
  margined.assign(stride * (height + 2 * reach), kFree);
  alone.assign(width * height, 0);
  // `row` of the stamp of a cell, or that row `below` it.
  const auto stamp = [&](std::size_t x, std::size_t y, std::size_t row, std::size_t below = 0) {
    raise(&margined[(y + row + below) * stride + x], &stamp_[row * stamp_width_], stamp_width_);
  };
  const auto lethal = [&](std::size_t x, std::size_t y) { return cost_[y * width + x] == kLethal; };
  const auto buried = [&](std::size_t x, std::size_t y) {
    return (x == 0 || lethal(x - 1, y)) && (x + 1 == width || lethal(x + 1, y)) && (y == 0 || lethal(x, y - 1)) &&
           (y + 1 == height || lethal(x, y + 1));
  };
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t first = 0, end = 0; (first = next_byte(&cost_[y * width], kLethal, end, width)) < width;) {
      for (end = first + 1; end < width && lethal(end, y);) ++end;
      while (first < end && buried(first, y)) ++first;
      if (first == end) continue;
      std::size_t last = end - 1;
      while (buried(last, y)) --last;
      if (last - first < 2) {
        for (std::size_t x = first; x <= last; ++x) alone[y * width + x] = kLethal;
        continue;
      }
      for (std::size_t row = 0; row < side; ++row) {
        stamp(first, y, row);
        stamp(last, y, row);
        std::uint8_t* const between = &margined[(y + row) * stride + reach];
        const std::uint8_t beside = stamp_[row * stamp_width_ + reach];
        for (std::size_t x = first; x < last; ++x) between[x] = std::max(between[x], beside);
      }
    }
  }
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; (x = next_byte(&alone[y * width], kLethal, x, width)) < width; ++x) {
      if (y > 0 && alone[(y - 1) * width + x]) continue;  // the run began below
      std::size_t more = 0;                               // cells of the run along the column
      while (y + more + 1 < height && alone[(y + more + 1) * width + x]) ++more;
      for (std::size_t row = 0; row < reach; ++row) stamp(x, y, row);
      for (std::size_t below = 0; below <= more; ++below) stamp(x, y, reach, below);
      for (std::size_t row = reach + 1; row < side; ++row) stamp(x, y, row, more);
    }
  }
  for (std::size_t y = 0; y < height; ++y) {
    raise(&cost_[y * width], &margined[(y + reach) * stride + reach], width);
  }
}

}  // namespace mrpbench::local
