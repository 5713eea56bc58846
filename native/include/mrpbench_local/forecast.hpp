// Objects that move, and where they will be, for critics.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_local/costmap/grid.hpp"
#include "mrpbench_options/options.hpp"

namespace mrpbench::local {

/// Discs with their places at 0, step, 2 * step, ... seconds from now.
struct Forecast {
  double step = 0.1;
  std::size_t count = 0;
  /// `count` of each disc, row by row, metres in the frame `map`.
  std::vector<Point> places;
  std::vector<double> radius;

  std::size_t size() const { return radius.size(); }
  std::span<const Point> of(std::size_t disc) const { return {places.data() + disc * count, count}; }
  /// The place of a disc at a time that is not beyond the last one, in a straight line between two places.
  Point at(std::size_t disc, double time) const;
  double duration() const { return step * static_cast<double>(count - 1); }
};

/// The options of critics that keep away from predicted places, of DWB and MPPI alike.
struct ForecastOptions {
  double distance = 0.5, near_score = 0.05, last_weight = 0.5;

  /// The rows of a struct that derives from this one.
  template <class Options>
  static Description<Options> rows() {
    return {{"distance", static_cast<double Options::*>(&ForecastOptions::distance), above(0, "m"),
             "distance from where an object will be within which a pose scores"},
            {"near_score", static_cast<double Options::*>(&ForecastOptions::near_score), at_least(0),
             "score of a pose at which both would touch; of one at which they overlap 1, and more the deeper"},
            {"last_weight", static_cast<double Options::*>(&ForecastOptions::last_weight), within(0, 1),
             "factor of scores at the end of the horizon, 1 now; between both it decreases steadily"}};
  }

  double weight(double time, double horizon) const { return 1 - (1 - last_weight) * time / horizon; }
};

/// The score of a pose by the gap between the robot and a disc, negative where both overlap; `touching` is the distance
/// of their centres where they touch.
inline double forecast_score(double gap, double touching, const ForecastOptions& options) {
  if (gap < 0) return 1 - gap / touching;
  if (gap >= options.distance) return 0;
  const double share = 1 - gap / options.distance;
  return options.near_score * share * share;
}

/// The discs that a robot, which has `radius` and drives `way` metres at most, could come within `distance` of.
std::vector<std::size_t> within_reach(const Forecast& forecast, Point robot, double radius, double way,
                                      double distance);

}  // namespace mrpbench::local
