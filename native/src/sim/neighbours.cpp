#include "mrpbench_sim/neighbours.hpp"

#include <algorithm>

namespace mrpbench::sim {

namespace {

double largest_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

/// Large enough that lists last for several steps, small enough that they contain few discs.
double skin_of(double largest) {
  return std::max(largest, 0.02);
}

}  // namespace

Neighbours::Neighbours(std::vector<Segment> segments, std::vector<double> radius, int robots)
    : segments_(std::move(segments)),
      fixed_(segments_.size()),
      radius_(std::move(radius)),
      robots_(robots),
      largest_(largest_of(radius_)),
      skin_(skin_of(largest_)),
      buckets_(segments_, largest_ + skin_ / 2, std::max(0.5, largest_)),
      hash_(2 * largest_ + skin_) {}

bool Neighbours::hold(std::span<const Point> centres) const {
  if (built_for_.size() != centres.size()) return false;
  const double limit = skin_ * skin_ / 4;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Point moved = centres[i] - built_for_[i];
    if (!(dot(moved, moved) <= limit) && centres[i] != built_for_[i]) return false;  // an absent disc may stay absent
  }
  return true;
}

void Neighbours::set_leaves(std::span<const Segment> leaves) {
  segments_.resize(fixed_);
  segments_.insert(segments_.end(), leaves.begin(), leaves.end());
  built_for_.clear();
}

void Neighbours::refresh(std::span<const Point> centres) {
  if (hold(centres)) return;
  built_for_.assign(centres.begin(), centres.end());
  hash_.build(centres);
  discs_.clear();
  walls_.clear();
  first_disc_.assign(1, 0);
  first_wall_.assign(1, 0);
  for (int robot = 0; robot < robots_; ++robot) {
    const Point centre = centres[static_cast<std::size_t>(robot)];
    hash_.near(centre, radius(robot) + largest_ + skin_, [&](int other) {
      const Point offset = centres[static_cast<std::size_t>(other)] - centre;
      const double reach = radius(robot) + radius(other) + skin_;
      if (other != robot && dot(offset, offset) <= reach * reach) discs_.push_back(other);
    });
    std::sort(discs_.begin() + static_cast<std::ptrdiff_t>(first_disc_.back()), discs_.end());
    first_disc_.push_back(discs_.size());
    const auto list = [&](int wall) {
      if (length(gap(segment(wall), centre)) <= radius(robot) + skin_ / 2) walls_.push_back(wall);
    };
    for (const int wall : buckets_.near(centre)) list(wall);
    for (std::size_t leaf = fixed_; leaf < segments_.size(); ++leaf) list(static_cast<int>(leaf));
    first_wall_.push_back(walls_.size());
  }
}

}  // namespace mrpbench::sim
