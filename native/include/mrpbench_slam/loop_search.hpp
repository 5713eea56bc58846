// Where a scan fits an earlier submap, in a large window: branch and bound over fields of maxima (Hess et al. 2016,
// section V, algorithm 3). The result is that of the exhaustive search, at a fraction of its time.
#pragma once

#include <optional>

#include "mrpbench_slam/matching.hpp"

namespace mrpbench::slam {

class LoopSearch {
 public:
  /// Computes the maxima of the field over squares of 2, 4, 8, ... cells, up to `half` metres.
  LoopSearch(Field field, double half);

  /// The best pose in the window whose response is at least `least`, or nothing.
  std::optional<Match> best(const Scan& scan, Pose around, const Window& window, const Keeping& keeping,
                            double least) const;

  const Field& field() const { return field_; }

 private:
  struct Node;
  struct Search;

  /// The largest response of the cells from `it` on, `1 << level` to each side.
  std::uint8_t maximum(std::size_t level, Cell it) const;
  void descend(const Search& search, const Node& node, Node& best, double& highest) const;

  Field field_;
  /// `maxima_[h - 1]` is of level h.
  std::vector<Grid<std::uint8_t>> maxima_;
};

}  // namespace mrpbench::slam
