// The parameters of Nav2's AMCL, by its names and with its defaults; metres, radians.
#pragma once

#include "mrpbench_options/options.hpp"

namespace mrpbench::amcl {

struct Parameters {
  double alpha1 = 0.2, alpha2 = 0.2, alpha3 = 0.2, alpha4 = 0.2;
  double z_hit = 0.5, z_rand = 0.5, sigma_hit = 0.2, laser_likelihood_max_dist = 2.0;
  int max_beams = 60;
  /// Whether the errors of beams count as independent, so that likelihoods are multiplied (`likelihood_field_prob`).
  /// Real errors are correlated, since an object that is not on the map reflects many beams; therefore the default adds
  /// up the cubes of likelihoods (`likelihood_field`).
  bool independent_beams = false;
  int min_particles = 500, max_particles = 2000;
  double pf_err = 0.05, pf_z = 0.99;
  int resample_interval = 1;
  double update_min_d = 0.25, update_min_a = 0.2;
  /// The ratio of these averages of likelihoods is the share of particles that are placed at random.
  double recovery_alpha_slow = 0, recovery_alpha_fast = 0;
  /// Variances of the initial pose; smaller than Nav2's, since the placement is known.
  double initial_cov_xx = 0.01, initial_cov_yy = 0.01, initial_cov_aa = 0.01;

  static Description<Parameters> description() {
    using P = Parameters;
    return {
        {"alpha1", &P::alpha1, at_least(0), "noise of rotation from rotation"},
        {"alpha2", &P::alpha2, at_least(0), "noise of rotation from translation"},
        {"alpha3", &P::alpha3, at_least(0), "noise of translation from translation"},
        {"alpha4", &P::alpha4, at_least(0), "noise of translation from rotation"},
        {"laser_likelihood_max_dist", &P::laser_likelihood_max_dist, above(0, "m"),
         "distance from walls and obstacles beyond which likelihoods are equal"},
        {"laser_model_type", &P::independent_beams,
         Choices<bool>{{"likelihood_field", false}, {"likelihood_field_prob", true}},
         "sum the cubes of the beams' likelihoods, or with likelihood_field_prob multiply them; there is no `beam`"},
        {"max_beams", &P::max_beams, at_least(1), "number of evenly spaced beams used of a scan"},
        {"max_particles", &P::max_particles, at_least(1), "largest number of particles of a robot"},
        {"min_particles", &P::min_particles, at_least(1), "smallest number of particles of a robot"},
        {"pf_err", &P::pf_err, above(0), "largest error between the true and the estimated distribution"},
        {"pf_z", &P::pf_z, at_least(0),
         "standard normal quantile of the probability that the error is smaller than pf_err"},
        {"recovery_alpha_fast", &P::recovery_alpha_fast, within(0, 1),
         "decay of the short average of likelihoods; 0 = no recovery"},
        {"recovery_alpha_slow", &P::recovery_alpha_slow, within(0, 1),
         "decay of the long average of likelihoods; 0 = no recovery"},
        {"resample_interval", &P::resample_interval, at_least(1), "updates per resampling"},
        {"sigma_hit", &P::sigma_hit, above(0, "m"), "standard deviation of a hit"},
        {"update_min_a", &P::update_min_a, at_least(0), "turn after which the next scan is used, radians"},
        {"update_min_d", &P::update_min_d, at_least(0, "m"), "distance after which the next scan is used"},
        {"z_hit", &P::z_hit, at_least(0), "weight of hits"},
        {"z_rand", &P::z_rand, at_least(0), "weight of random ranges"},
        {"initial_cov_xx", &P::initial_cov_xx, at_least(0), "variance of a placement's x, square metres"},
        {"initial_cov_yy", &P::initial_cov_yy, at_least(0), "variance of its y, square metres"},
        {"initial_cov_aa", &P::initial_cov_aa, at_least(0), "variance of its yaw, square radians"}};
  }
};

}  // namespace mrpbench::amcl
