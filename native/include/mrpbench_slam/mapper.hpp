// One robot's localisation and mapping: scans are matched with the older of two growing submaps, as in the local SLAM
// of Hess et al. 2016, and a graph of the poses of all scans corrects them where the robot comes back to an earlier
// submap.
#pragma once

#include <optional>
#include <vector>

#include "mrpbench_slam/loop_search.hpp"
#include "mrpbench_slam/occupancy_map.hpp"
#include "mrpbench_slam/parameters.hpp"
#include "mrpbench_slam/pose_graph.hpp"
#include "mrpbench_slam/submap.hpp"

namespace mrpbench::slam {

class Mapper {
 public:
  /// The first scan is taken at `start`, in the frame of the map.
  Mapper(Pose start, const Parameters& parameters);

  /// Set the odometry at the start.
  void begin(Pose odometry) { odometry_ = odometry; }

  /// True if a scan taken now would be used: the first is, and later ones after motion and time.
  bool wants(double now, Pose odometry) const;

  /// Match a scan taken at `odometry`, and add it to the map.
  void take(double now, Pose odometry, Scan scan);

  /// The pose: that of the last scan, moved by the odometry since then.
  Pose pose(Pose odometry) const { return composed(corrected_, relative(odometry_, odometry)); }

  /// The poses of all scans in the frame of the map.
  const std::vector<Pose>& poses() const { return poses_; }
  /// Number of loops that have moved poses.
  std::size_t loops() const { return loops_; }

  /// Bring the map up to date, and return the tiles of the map that differ from those of the last call.
  std::vector<Tile> changed_tiles();

 private:
  struct Active {
    Submap submap;
    std::size_t first;
  };
  /// An earlier submap in the frame of local SLAM.
  struct Earlier {
    Submap submap;
    /// Its scans.
    std::size_t first, last;
    /// Made for the first search.
    std::optional<LoopSearch> search;
  };

  Match matched(const Scan& scan, Pose predicted);
  void insert(const Scan& scan, Pose pose);
  void connect(Pose local, const Information& seen);
  void close_loop();
  const Earlier* nearest_earlier() const;
  /// Where the frame of local SLAM lies in the map, as scan `index` has it.
  Pose frame_of(std::size_t index) const { return composed(poses_[index], relative(local_[index], Pose{})); }

  Parameters parameters_;
  std::vector<Active> active_;
  std::vector<Earlier> earlier_;
  CorrelativeSearch search_;
  std::vector<Scan> scans_;
  std::vector<Pose> local_, poses_;
  /// Metres driven up to each scan.
  std::vector<double> driven_;
  std::vector<Constraint> constraints_;
  std::size_t loops_ = 0, last_loop_ = 0;
  OccupancyMap map_;
  Pose odometry_, corrected_;
  double time_ = 0;
};

}  // namespace mrpbench::slam
