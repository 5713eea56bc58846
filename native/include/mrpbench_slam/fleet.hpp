// Localisation and mapping of a fleet: every robot has a map of its own.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_slam/mapper.hpp"

namespace mrpbench::slam {

/// Scans of several robots, row by row, by lidars of one kind.
struct Scans {
  std::span<const int> robots;
  std::span<const double> ranges;
  Lidar lidar;
};

class Fleet {
 public:
  /// Throws std::invalid_argument for placements that are not finite.
  Fleet(const std::vector<Pose>& placements, const Parameters& parameters);

  /// Set the odometry at the placements, one pose for each robot; call this once, before all other methods.
  void begin(std::span<const Pose> odometry);

  /// Use the scans taken at `odometry` of robots that have moved far enough since the last one.
  void sense(const Scans& scans, std::span<const Pose> odometry, double now);

  const Mapper& robot(std::size_t index) const { return mappers_[index]; }
  Mapper& robot(std::size_t index) { return mappers_[index]; }
  std::size_t size() const { return mappers_.size(); }

 private:
  void check(std::span<const Pose> odometry) const;

  int max_beams_;
  std::vector<Mapper> mappers_;
};

}  // namespace mrpbench::slam
