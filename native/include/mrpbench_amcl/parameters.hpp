// The parameters of Nav2's AMCL, by its names and with its defaults; metres, radians.
#pragma once

namespace mrpbench::amcl {

struct Parameters {
  /// Variance of odometry: of turns by turns (1) and by ways (2), of ways by ways (3) and by turns (4).
  double alpha1 = 0.2, alpha2 = 0.2, alpha3 = 0.2, alpha4 = 0.2;
  /// Weights of what a beam may have met, and how far it then errs.
  double z_hit = 0.5, z_rand = 0.5, sigma_hit = 0.2, laser_likelihood_max_dist = 2.0;
  int max_beams = 60;
  /// Whether beams err independently, so that their likelihoods are multiplied (`likelihood_field_prob`). In truth they
  /// err together, since what is not on the map takes many; else their cubes are added up (`likelihood_field`).
  bool independent_beams = false;
  int min_particles = 500, max_particles = 2000;
  /// Error that the particles may have, and the quantile of how surely they have less.
  double pf_err = 0.05, pf_z = 0.99;
  /// Updates per resampling.
  int resample_interval = 1;
  /// How far a robot moves or turns before a scan counts.
  double update_min_d = 0.25, update_min_a = 0.2;
  /// Decay of the averages whose ratio says how many particles to place anywhere; 0 = none.
  double recovery_alpha_slow = 0, recovery_alpha_fast = 0;
  /// Variances of where a robot was placed; smaller than Nav2's, since it is known.
  double initial_cov_xx = 0.01, initial_cov_yy = 0.01, initial_cov_aa = 0.01;
};

}  // namespace mrpbench::amcl
