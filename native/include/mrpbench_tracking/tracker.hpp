// Objects followed from scan to scan.
#pragma once

#include "mrpbench_tracking/detector.hpp"

namespace mrpbench::tracking {

/// An object with its estimated state, by a Kalman filter with constant velocity and white-noise acceleration. Both
/// axes have the same covariance.
struct Track {
  Point place, velocity;
  /// Of place, of place with velocity, and of velocity, m^2, m^2/s, m^2/s^2.
  double pp = 0, pv = 0, vv = 0;
  int detections = 1;
  /// Simulated seconds of the last detection.
  double detected = 0;

  /// Let `dt` seconds pass.
  void predict(double dt, double acceleration_deviation);
  void correct(Point detected_at, double deviation);
};

/// The tracks of one robot: detections belong to the nearest track within the gating distance, nearest pairs first
/// (greedy nearest neighbour; Y. Bar-Shalom, X. R. Li and T. Kirubarajan, "Estimation with Applications to Tracking and
/// Navigation", Wiley 2001, chapter 6 for the filter).
class Tracker {
 public:
  /// Take the detections of a scan. Returns the index of the track of each detection.
  std::vector<std::size_t> update(double now, std::span<const Detection> detections, const Options& options);

  const std::vector<Track>& tracks() const { return tracks_; }

 private:
  std::vector<Track> tracks_;
  double updated_ = 0;
};

/// Tell whether a track is that of an object that moves.
bool moves(const Track& track, const Options& options);

}  // namespace mrpbench::tracking
