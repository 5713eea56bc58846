// A submap: an occupancy grid of some scans, each cell with the logarithm of its odds (Hess et al. 2016, section IV).
// What moves leaves a cell occupied only until enough beams have passed it.
#pragma once

#include "mrpbench_slam/field.hpp"

namespace mrpbench::slam {

class Submap {
 public:
  Submap(double resolution, double deviation) : field_(resolution, deviation) {}

  /// Add a scan taken at a pose. A beam makes the cell of its return more likely occupied, and those before it less;
  /// each cell changes once for a scan, and returns come first.
  void insert(const Scan& scan, Pose pose);

  bool occupied(Cell it) const { return cells_.value(it).odds > 0; }
  const Field& field() const { return field_; }
  int scans() const { return scans_; }

  /// The share of the returns of a scan, taken at a pose, that lie on or next to cells that were seen.
  double overlap(const Scan& scan, Pose pose) const;

  /// A field of the occupied cells with another deviation.
  Field field_of(double deviation) const;

 private:
  struct Odds {
    /// In twentieths, above 0 = more likely occupied.
    std::int8_t odds = 0;
    /// Number of the last scan that changed it.
    std::uint8_t scan = 0;
  };

  void change(Cell it, int by);

  Field field_;
  Grid<Odds> cells_;
  int scans_ = 0;
};

}  // namespace mrpbench::slam
