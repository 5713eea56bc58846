// What each robot could touch. Lists with a skin: they stay valid until something has moved by half of it (L. Verlet,
// "Computer experiments on classical fluids", Physical Review 159, 1967), so that most steps need no search at all.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_sim/disc_hash.hpp"
#include "mrpbench_sim/segment_buckets.hpp"

namespace mrpbench::sim {

class Neighbours {
 public:
  /// Discs with `radius`, of which the first `robots` are robots.
  Neighbours(std::vector<Segment> segments, std::vector<double> radius, int robots);

  /// Replace the solid segments that may change, in addition to those of the constructor.
  void set_leaves(std::span<const Segment> leaves);

  /// Update the lists for `centres`.
  void refresh(std::span<const Point> centres);

  /// Discs that may touch a robot, in ascending order.
  std::span<const int> discs(int robot) const { return row(discs_, first_disc_, robot); }
  /// Segments that may touch a robot, in ascending order.
  std::span<const int> walls(int robot) const { return row(walls_, first_wall_, robot); }

  const Segment& segment(int index) const { return segments_[static_cast<std::size_t>(index)]; }
  double radius(int disc) const { return radius_[static_cast<std::size_t>(disc)]; }
  int robots() const { return robots_; }

 private:
  static std::span<const int> row(const std::vector<int>& values, const std::vector<std::size_t>& first, int index) {
    const auto at = static_cast<std::size_t>(index);
    return {values.data() + first[at], first[at + 1] - first[at]};
  }
  bool hold(std::span<const Point> centres) const;

  std::vector<Segment> segments_;  // the fixed ones, then the leaves
  std::size_t fixed_;
  std::vector<double> radius_;
  int robots_;
  double largest_, skin_;
  SegmentBuckets buckets_;
  DiscHash hash_;
  std::vector<Point> built_for_;
  std::vector<int> discs_, walls_;
  std::vector<std::size_t> first_disc_, first_wall_;
};

}  // namespace mrpbench::sim
