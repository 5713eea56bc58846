// A rolling costmap around a robot, with the layers of Nav2's local costmap: obstacles from scans, the static
// map, inflation. Written from Nav2's documentation and parameters (navigation.ros.org, "Costmap 2D").
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mrpbench_local/costmap/cell_set.hpp"
#include "mrpbench_local/costmap/grid.hpp"
#include "mrpbench_options/options.hpp"
#include "mrpbench_sim/segment_buckets.hpp"

namespace mrpbench::local {

constexpr std::uint8_t kFree = 0, kInscribed = 253, kLethal = 254;

struct CostmapOptions {
  double width = 3, height = 3, resolution = 0.05, update_frequency = 5, footprint_padding = 0.01;
  bool obstacle_layer = true, static_layer = false, inflation_layer = true;
  double obstacle_max_range = 2.5, obstacle_min_range = 0, raytrace_max_range = 3, raytrace_min_range = 0;
  bool marking = true, clearing = true, inf_is_valid = false, footprint_clearing = true;
  double inflation_radius = 0.55, cost_scaling_factor = 3;
  /// Padded, about the robot's origin.
  std::vector<Point> footprint;

  static Description<CostmapOptions> grid();
  static Description<CostmapOptions> inflation();
  static Description<CostmapOptions> observation();
  static Description<CostmapOptions> layers();
};

/// What is solid in the static map, shared by all robots.
struct StaticMap {
  StaticMap(std::vector<Segment> walls, double reach) : segments(std::move(walls)), buckets(segments, reach, 1.0) {}
  std::vector<Segment> segments;
  sim::SegmentBuckets buckets;
};

/// Where a lidar sits, and how far it sees.
struct Sensor {
  Point mount;
  double range = 0;
};

class Costmap {
 public:
  Costmap(CostmapOptions options, std::shared_ptr<const StaticMap> walls);

  /// Keep a scan taken at `pose` for the next update; beam i points at i * 2*pi / beams from straight ahead.
  void see(Pose pose, const Sensor& sensor, std::span<const double> ranges);
  /// Centre on the robot, apply the scan that is kept, inflate.
  void update(Pose pose);
  /// Remove all marks.
  void clear();

  /// Tell whether it was ever updated.
  bool knows() const { return known_; }
  const Frame& frame() const { return frame_; }
  const CostmapOptions& options() const { return options_; }
  double inscribed() const { return inscribed_; }
  std::uint8_t at(Cell c) const { return cost_[frame_.index(c)]; }
  /// Tell whether the robot's centre may be at a point, whose cell is `c`: where it is farther than the inscribed
  /// radius from the points that beams hit. Nav2 forbids cells of the cost `kInscribed`, by the centres of cells, which
  /// are off by up to a cell's diagonal from these points and the robot. A robot that was closer at the last update may
  /// drive where it comes no closer, so that it can leave.
  bool is_free(Cell c, Point p) const { return is_clear(c) || (at(c) <= kInscribed && keeps_room(p)); }
  /// Tell whether what is lethal is so far from a cell that the robot's centre may be anywhere in it.
  bool is_clear(Cell c) const { return at(c) < close_; }
  const std::vector<std::uint8_t>& costs() const { return cost_; }
  /// Begin to load the costs near the robot into the cache.
  void fetch() const {
    for (std::size_t i = cost_.size() / 4; i < cost_.size() * 3 / 4; i += 64) __builtin_prefetch(&cost_[i]);
  }
  /// Mark the cells (of this frame) through which outlines of the static map pass.
  void draw_walls(std::vector<std::uint8_t>& cells) const;

 private:
  void roll(Pose pose);
  void trace();
  void mark_hits();
  void clear_beams(Cell start);
  void clear_footprint(Pose pose);
  template <class Visit>
  void each_wall_cell(Visit&& visit) const;
  template <class Visit>
  bool each_nearby(Point p, Visit&& visit) const;
  /// Tell whether a point is at least as far from what beams hit as the robot was at the last update.
  bool keeps_room(Point p) const;
  /// Compute the costs around one lethal cell.
  void draw_stamp();
  void inflate();

  CostmapOptions options_;
  std::shared_ptr<const StaticMap> walls_;
  double inscribed_;
  Frame frame_;
  Pose pose_;  // of the last update
  bool known_ = false;
  /// Whether an update at that pose with the scan that was seen last would change nothing.
  bool settled_ = false;
  CellSet marks_, lethal_;
  std::vector<std::uint8_t> cost_;
  /// Where in a marked cell the nearest beam of the last scan that hit it ended, in cells from its lower left corner.
  /// The mean of all beams would lie inside of corners and thin pillars, of which two sides are seen.
  struct Hit {
    float x = 0.5f, y = 0.5f;
  };
  /// By the plane's columns and rows modulo the size of the frame, so that they stay when the frame moves.
  std::vector<Hit> hits_;
  Cell first_;  // the column and row in `hits_` of the frame's first cell
  std::size_t hit_of(Cell c) const {
    const int x = c.x + first_.x, y = c.y + first_.y;
    return frame_.index({x < frame_.width ? x : x - frame_.width, y < frame_.height ? y : y - frame_.height});
  }
  /// Metres that the robot keeps from what beams hit.
  double room_ = 0;
  /// The least cost of a cell in which the robot's centre may be too close to what is lethal.
  std::uint8_t close_ = kInscribed;
  struct {
    Pose pose;
    Sensor sensor;
    std::vector<double> ranges;
    bool fresh = false;
  } scan_;
  /// Cells of the inflation radius, and costs within it around one lethal cell, row by row.
  int reach_ = 0;
  std::size_t stamp_width_ = 0;
  std::vector<std::uint8_t> stamp_;
  std::vector<Point> corners_;
};

/// Nav2's formula: cost at `distance` metres from something lethal.
std::uint8_t inflated_cost(double distance, double inscribed, double cost_scaling_factor);

}  // namespace mrpbench::local
