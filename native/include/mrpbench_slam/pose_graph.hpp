// Poses from relative poses: the least squares of F. Lu and E. Milios, "Globally Consistent Range Scan Alignment for
// Environment Mapping", Autonomous Robots 4, 1997, on SE(2) by Levenberg's and Marquardt's method (G. Grisetti,
// R. Kümmerle, C. Stachniss and W. Burgard, "A Tutorial on Graph-Based SLAM", ITS Magazine 2, 2010).
#pragma once

#include <cstddef>
#include <vector>

#include "mrpbench_slam/matching.hpp"

namespace mrpbench::slam {

/// The pose of node `to` in the frame of node `from`, as it was measured.
struct Constraint {
  std::size_t from = 0, to = 0;
  Pose measured;
  Information information{};
  /// Errors beyond this many standard deviations count linearly (Huber's loss); 0 = all count by their squares.
  double huber = 0;
};

/// Half of the sum of the losses of all constraints.
double cost_of(const std::vector<Pose>& poses, const std::vector<Constraint>& constraints);

/// Move the poses, apart from the first `fixed` ones, so that the cost is least; returns the cost. The equations are
/// solved by Cholesky's decomposition within their envelope, which in the order of time is narrow except in the rows of
/// loops.
double optimise(std::vector<Pose>& poses, const std::vector<Constraint>& constraints, std::size_t fixed = 1);

}  // namespace mrpbench::slam
