#include "mrpbench_tracking/options.hpp"

namespace mrpbench::tracking {

Description<Options> Options::description() {
  using O = Options;
  return {{"horizon", &O::horizon, within(0.1, 30, "s"), "time ahead for which objects are predicted"},
          {"radius", &O::radius, within(0.01, 5, "m"), "radius that an object is assumed to have"},
          {"largest_object", &O::largest_object, within(0.05, 10, "m"),
           "extent of the points of one object at most, as of two legs at full stride; what is wider is not tracked"},
          {"wall_distance", &O::wall_distance, within(0, 5, "m"),
           "points this close to a wall of the map are points of that wall"},
          {"robot_distance", &O::robot_distance, within(0, 5, "m"),
           "points this close to the footprint of another robot of the fleet are points of that robot"},
          {"segment_gap", &O::segment_gap, within(0.01, 5, "m"),
           "points of neighbouring beams that are closer, beyond the distance of the beams there, are of one segment"},
          {"gating_distance", &O::gating_distance, above(0, "m"),
           "distance at most between the place predicted of a track and that of a detection"},
          {"lost_after", &O::lost_after, above(0, "s"), "time after which a track without detections ends"},
          {"confirmed_after", &O::confirmed_after, within(2, 100),
           "detections from which on a track is that of an object; the velocity is unknown before the second"},
          {"least_speed", &O::least_speed, at_least(0, "m/s"),
           "speed from which on an object moves: then it is predicted, and its points mark nothing in the costmap"},
          {"measurement_deviation", &O::measurement_deviation, above(0, "m"),
           "standard deviation of the place of a detection"},
          {"acceleration_deviation", &O::acceleration_deviation, above(0),
           "standard deviation of the white noise that accelerates objects, m/s^1.5"}};
}

}  // namespace mrpbench::tracking
