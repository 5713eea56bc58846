// The parameters of localisation and mapping: those of slam_toolbox by its names where they mean the same, and those of
// W. Hess, D. Kohler, H. Rapp and D. Andor, "Real-Time Loop Closure in 2D LIDAR SLAM", ICRA 2016. Metres, radians.
#pragma once

#include "mrpbench_options/options.hpp"

namespace mrpbench::slam {

struct Parameters {
  double resolution = 0.05;
  double minimum_travel_distance = 0.5, minimum_travel_heading = 0.5, minimum_time_interval = 0.5;
  bool use_scan_matching = true;
  double correlation_search_space_dimension = 0.5, correlation_search_space_smear_deviation = 0.05;
  double coarse_search_angle_offset = 0.349, coarse_angle_resolution = 0.0349;
  double translation_weight = 4, rotation_weight = 0.3;
  int max_beams = 120, submap_scans = 20;
  bool do_loop_closing = true;
  double loop_search_maximum_distance = 3, loop_search_space_dimension = 8, loop_search_space_smear_deviation = 0.03;
  int loop_match_minimum_chain_size = 10;
  double loop_match_minimum_response_coarse = 0.35, loop_match_minimum_response_fine = 0.45;
  int min_pass_through = 2;
  double occupancy_threshold = 0.1;

  static Description<Parameters> description() {
    using P = Parameters;
    const std::string hess = "Hess et al. 2016";
    return {{"resolution", &P::resolution, within(0.01, 1, "m"), "side of the cells of submaps and of the map"},
            {"minimum_travel_distance", &P::minimum_travel_distance, at_least(0, "m"),
             "distance after which the next scan is matched"},
            {"minimum_travel_heading", &P::minimum_travel_heading, at_least(0),
             "turn after which the next scan is matched, radians"},
            {"minimum_time_interval", &P::minimum_time_interval, at_least(0, "s"),
             "time between two scans that are matched"},
            {"use_scan_matching", &P::use_scan_matching,
             "correct the odometry by scans; otherwise scans only build the map"},
            {"correlation_search_space_dimension", &P::correlation_search_space_dimension, within(0, 5, "m"),
             "width of the square around the odometry's position in which a scan is matched"},
            {"correlation_search_space_smear_deviation", &P::correlation_search_space_smear_deviation,
             within(0.01, 1, "m"), "standard deviation of the distance of a return from an occupied cell"},
            {"coarse_search_angle_offset", &P::coarse_search_angle_offset, within(0, 3.2),
             "turn to either side of the odometry's yaw up to which a scan is matched, radians"},
            {"coarse_angle_resolution", &P::coarse_angle_resolution, within(0.001, 1),
             "largest step between two yaws of the search, radians"},
            {"translation_weight", &P::translation_weight, at_least(0),
             "how much a match keeps to the odometry's position", hess},
            {"rotation_weight", &P::rotation_weight, at_least(0), "how much a match keeps to the odometry's yaw", hess},
            {"max_beams", &P::max_beams, at_least(1), "number of evenly spaced returns of a scan that are matched"},
            {"submap_scans", &P::submap_scans, within(2, 100), "number of scans in a submap before the next one begins",
             hess},
            {"do_loop_closing", &P::do_loop_closing,
             "match scans with earlier submaps, and correct the map by what is found"},
            {"loop_search_maximum_distance", &P::loop_search_maximum_distance, at_least(0, "m"),
             "distance from an earlier submap's scans up to which a loop may close"},
            {"loop_search_space_dimension", &P::loop_search_space_dimension, within(0, 50, "m"),
             "largest width of the square in which a scan is matched with an earlier submap"},
            {"loop_search_space_smear_deviation", &P::loop_search_space_smear_deviation, within(0.01, 1, "m"),
             "standard deviation of the distance of a return from an occupied cell of an earlier submap"},
            {"loop_match_minimum_chain_size", &P::loop_match_minimum_chain_size, at_least(1),
             "number of scans between an earlier submap and the scan that closes a loop to it, at least"},
            {"loop_match_minimum_response_coarse", &P::loop_match_minimum_response_coarse, within(0, 1),
             "mean response of the returns in the search at which a loop may close"},
            {"loop_match_minimum_response_fine", &P::loop_match_minimum_response_fine, within(0, 1),
             "mean response of the returns after refinement at which a loop closes"},
            {"min_pass_through", &P::min_pass_through, at_least(1),
             "number of beams through a cell of the map from which on it is known"},
            {"occupancy_threshold", &P::occupancy_threshold, within(0, 1),
             "share of these that must end in the cell for it to be occupied"}};
  }
};

}  // namespace mrpbench::slam
