// Where a scan fits a submap best: the correlative search of E. B. Olson, "Real-Time Correlative Scan Matching", ICRA
// 2009, then Gauss-Newton steps as in S. Kohlbrecher, O. von Stryk, J. Meyer and U. Klingauf, "A Flexible and Scalable
// SLAM System with Full 3D Motion Estimation", SSRR 2011.
#pragma once

#include <array>

#include "mrpbench_slam/field.hpp"

namespace mrpbench::slam {

/// Symmetric, of x, y, yaw in the frame of the robot, row by row.
using Information = std::array<double, 9>;

/// How much a match keeps to the pose that odometry gives: the mean response of the returns minus the squares of
/// weighted differences is what is maximised.
struct Keeping {
  double translation = 0, rotation = 0;

  double penalty(double squared, double turn) const {
    return translation * translation * squared + rotation * rotation * turn * turn;
  }
};

/// What a search covers around a pose.
struct Window {
  /// Metres to each side, and radians to either side.
  double half = 0, turn = 0;
  /// Largest step between yaws.
  double step = 0;
};

struct Match {
  Pose pose;
  /// Mean response of the returns, from 0 to 1.
  double response = 0;
};

/// The yaws of a search: enough that no return moves by more than twice the deviation from one to the next.
std::vector<double> yaws_of(double yaw, const Window& window, double reach, double deviation);

/// Evaluate every position of the window, one cell apart, at every yaw; returns the best one. Memory that it needs is
/// kept from call to call.
class CorrelativeSearch {
 public:
  Match best(const Field& field, const Scan& scan, Pose around, const Window& window, const Keeping& keeping);

 private:
  std::vector<std::uint32_t> sums_;
};

/// At most a dozen Gauss-Newton steps from `start` on the squared distances of the returns from what is occupied, each
/// across the surface that it lies on (A. Censi, "An ICP variant using a point-to-line metric", ICRA 2008) and weighted
/// by its response.
Match refined(const Field& field, const Scan& scan, Pose start, Pose around, const Keeping& keeping);

/// Mean response of the returns at a pose.
double response_of(const Field& field, const Scan& scan, Pose pose);

/// What a match says about the pose, from the normals of the returns that fit: along an aisle without features, nothing
/// (A. Censi, "On achievable accuracy for range-finder localization", ICRA 2007).
Information information_of(const Field& field, const Scan& scan, Pose pose);

}  // namespace mrpbench::slam
