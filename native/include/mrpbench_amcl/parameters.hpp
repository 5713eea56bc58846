// The parameters of Nav2's AMCL, by its names and with its defaults; metres, radians.
#pragma once

#include <map>
#include <string>
#include <variant>

namespace mrpbench::amcl {

struct Parameters {
  /// Variance of odometry: of turns by turns (1) and by distance (2), of distance by distance (3) and by turns (4).
  double alpha1 = 0.2, alpha2 = 0.2, alpha3 = 0.2, alpha4 = 0.2;
  /// Weights of hits and of random ranges, standard deviation of a hit, and the distance from walls beyond which all
  /// likelihoods are equal.
  double z_hit = 0.5, z_rand = 0.5, sigma_hit = 0.2, laser_likelihood_max_dist = 2.0;
  int max_beams = 60;
  /// Whether the errors of beams count as independent, so that likelihoods are multiplied (`likelihood_field_prob`).
  /// Real errors are correlated, since an object that is not on the map reflects many beams; therefore the default adds
  /// up the cubes of likelihoods (`likelihood_field`).
  bool independent_beams = false;
  int min_particles = 500, max_particles = 2000;
  /// Largest error of the distribution of particles, and the standard normal quantile of the probability that the error
  /// is smaller.
  double pf_err = 0.05, pf_z = 0.99;
  /// Updates per resampling.
  int resample_interval = 1;
  /// Distance and turn after which the next scan is used.
  double update_min_d = 0.25, update_min_a = 0.2;
  /// Decay of the averages of likelihoods, whose ratio is the share of particles that are placed at random; 0 = none.
  double recovery_alpha_slow = 0, recovery_alpha_fast = 0;
  /// Variances of the initial pose; smaller than Nav2's, since the placement is known.
  double initial_cov_xx = 0.01, initial_cov_yy = 0.01, initial_cov_aa = 0.01;

  using Field = std::variant<double Parameters::*, int Parameters::*, bool Parameters::*>;
  /// All parameters by name.
  static const std::map<std::string, Field>& fields() {
    using P = Parameters;
    static const std::map<std::string, Field> all{
        {"alpha1", &P::alpha1},
        {"alpha2", &P::alpha2},
        {"alpha3", &P::alpha3},
        {"alpha4", &P::alpha4},
        {"z_hit", &P::z_hit},
        {"z_rand", &P::z_rand},
        {"sigma_hit", &P::sigma_hit},
        {"laser_likelihood_max_dist", &P::laser_likelihood_max_dist},
        {"max_beams", &P::max_beams},
        {"independent_beams", &P::independent_beams},
        {"min_particles", &P::min_particles},
        {"max_particles", &P::max_particles},
        {"pf_err", &P::pf_err},
        {"pf_z", &P::pf_z},
        {"resample_interval", &P::resample_interval},
        {"update_min_d", &P::update_min_d},
        {"update_min_a", &P::update_min_a},
        {"recovery_alpha_slow", &P::recovery_alpha_slow},
        {"recovery_alpha_fast", &P::recovery_alpha_fast},
        {"initial_cov_xx", &P::initial_cov_xx},
        {"initial_cov_yy", &P::initial_cov_yy},
        {"initial_cov_aa", &P::initial_cov_aa},
    };
    return all;
  }
};

}  // namespace mrpbench::amcl
