// Spatial hashing of moving discs.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_sim/geometry.hpp"

namespace mrpbench::sim {

/// Largest distance from the origin along either axis, in metres; discs beyond it are absent.
constexpr double kFarthest = 1e9;

inline bool somewhere(Point p) {
  return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest;
}

/// Points by square cells of the plane, in a table as large as their number asks for. Memory is kept between builds.
class DiscHash {
 public:
  explicit DiscHash(double cell) : cell_(cell) {}

  /// Absent points are left out.
  void build(std::span<const Point> points);

  /// Calls `visit(index)` once for every point within `reach` of `centre`, and for some that are farther.
  template <class Visit>
  void near(Point centre, double reach, Visit&& visit) const {
    const std::int64_t left = cell(centre.x - reach), right = cell(centre.x + reach);
    const std::int64_t bottom = cell(centre.y - reach), top = cell(centre.y + reach);
    if ((right - left + 1) * (top - bottom + 1) >= static_cast<std::int64_t>(entries_.size())) {
      for (const Entry& entry : entries_) visit(entry.index);
      return;
    }
    for (std::int64_t row = bottom; row <= top; ++row) {
      for (std::int64_t column = left; column <= right; ++column) {
        const std::size_t slot = hash(column, row);
        for (std::size_t i = first_[slot]; i < first_[slot + 1]; ++i) {
          const Entry& entry = entries_[i];
          if (entry.column == column && entry.row == row) visit(entry.index);  // cells may share a slot
        }
      }
    }
  }

 private:
  struct Entry {
    std::int64_t column, row;
    int index;
  };

  std::int64_t cell(double coordinate) const { return static_cast<std::int64_t>(std::floor(coordinate / cell_)); }
  std::size_t hash(std::int64_t column, std::int64_t row) const {
    const auto mixed = static_cast<std::uint64_t>(column) * 0x9E3779B97F4A7C15u +
                       static_cast<std::uint64_t>(row) * 0xC2B2AE3D27D4EB4Fu;
    return static_cast<std::size_t>(mixed >> 32) & mask_;
  }

  double cell_;
  std::size_t mask_ = 0;
  std::vector<std::size_t> first_{0, 0};
  std::vector<Entry> found_, entries_;
};

}  // namespace mrpbench::sim
