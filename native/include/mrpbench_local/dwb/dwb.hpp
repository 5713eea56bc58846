// Nav2's DWB: the velocity whose trajectory has the best score of its critics. Written from Nav2's documentation
// (navigation.ros.org, "DWB Controller") and parameters.
#pragma once

#include "mrpbench_local/controller.hpp"
#include "mrpbench_local/dwb/critic.hpp"
#include "mrpbench_local/path/rotate_to_path.hpp"

namespace mrpbench::local {

struct DwbOptions {
  MotionOptions motion;
  Pruning pruning;
  double min_x_velocity_threshold = 0.001, min_theta_velocity_threshold = 0.001;
  bool short_circuit = true;
  double rotate_to_path = 0.4;

  static Description<DwbOptions> nav2();
  static Description<DwbOptions> further();
  static Description<DwbOptions> derived();
};

class Dwb : public Controller {
 public:
  struct Buffers;
  struct Weighted {
    std::string name;
    double scale = 1;
    std::unique_ptr<Critic> critic;
  };

  Dwb(const DwbOptions& options, std::vector<Weighted> critics);

  std::optional<Twist> command(const Situation& now, const Extra& extra) override;

  /// Call it before the next scan: it scores again. The trajectories from which the last command was chosen: names of
  /// the `critics`, `twist`, `pose`, raw `score` of each critic, `total`, the `reason` why each was dropped, and the
  /// `cost`: the total, infinite where there is such a reason. Totals of those that were not fully checked are partial.
  /// If one was chosen, its poses are `chosen` f8[p,3], and `chosen_score` has its scores, multiplied by the scales.
  /// Nothing where no trajectories were sampled.
  Explanation explain() const override;

 private:
  /// What the last command followed from, so that it can be explained. Scores of a fleet do not fit the cache.
  struct Sampled {
    /// Without what points into buffers.
    Scene scene;
    /// The beginning of the path, as far as it counts, and the speed at its end.
    std::vector<Point> path;
    double speed = 0;
    /// What the caller adds to the scores.
    std::vector<double> added;
  };

  double speed_to_stop(double left, double cell) const;
  void debrief();
  Scene sample(Buffers& its) const;
  void score(const Scene& scene, Buffers& its) const;
  void complete(const Scene& scene, Buffers& its) const;
  bool passes(const Scene& scene, Buffers& its, std::size_t i) const;
  std::optional<std::size_t> best(const Scene& scene, Buffers& its) const;

  DwbOptions options_;
  std::vector<Weighted> critics_;
  double looks_ahead_ = 0;  // metres, the most of all critics
  Sampled sampled_;
  bool has_sampled_ = false;  // for the last command
  std::optional<std::size_t> chosen_;
  Twist command_;
  std::optional<Pose> goal_;
  RotateToPath rotate_;
};

}  // namespace mrpbench::local
