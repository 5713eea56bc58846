// The observation `default` of POGEMA 1.4 (Skrynnik et al., ICLR 2025).
#include <algorithm>

#include "mrpbench_grid/cells.hpp"

namespace mrpbench::grid {

namespace {

/// Copies a window of bytes as numbers. `fixed` is the number of rows and columns if it is known to the compiler.
template <int fixed>
float* copy_window(const std::uint8_t* row, Place width, Place side, float* out) {
  if constexpr (fixed > 0) side = fixed;
  for (Place r = 0; r < side; ++r, row += width, out += side)
    for (Place c = 0; c < side; ++c) out[c] = static_cast<float>(row[c]);
  return out;
}

constexpr int usual = 11;  // the windows of POGEMA's benchmark

}  // namespace

void Cells::pogema(std::span<const bool> shown, std::span<const Place> place, std::span<const Place> goal, Place radius,
                   std::span<float> windows) {
  const Place side = 2 * radius + 1, corner = radius * (width_ + 1);
  const auto copy = side == usual ? copy_window<usual> : copy_window<0>;
  const auto width = static_cast<std::uint32_t>(width_);
  shown_.resize(size());
  for (std::size_t i = 0; i < place.size(); ++i)
    if (shown[i]) shown_[place[i]] = 1;
  float* out = windows.data();
  for (std::size_t i = 0; i < place.size(); ++i) {
    out = copy(blocked_.data() + place[i] - corner, width_, side, out);
    out = copy(shown_.data() + place[i] - corner, width_, side, out);
    std::fill_n(out, side * side, 0.0F);
    const auto here = static_cast<std::uint32_t>(place[i]), there = static_cast<std::uint32_t>(goal[i]);
    const Place rows = Place{there / width} - Place{here / width};
    const Place columns = Place{there % width} - Place{here % width};
    out[(std::clamp(rows, -radius, radius) + radius) * side + std::clamp(columns, -radius, radius) + radius] = 1.0F;
    out += side * side;
  }
  for (const Place it : place) shown_[it] = 0;
}

}  // namespace mrpbench::grid
