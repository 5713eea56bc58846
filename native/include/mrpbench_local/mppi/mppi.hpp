// Nav2's MPPI controller.
#pragma once

#include <array>

#include "mrpbench_local/controller.hpp"
#include "mrpbench_local/mppi/critic.hpp"
#include "mrpbench_local/mppi/plan.hpp"
#include "mrpbench_local/mppi/rollout.hpp"
#include "mrpbench_local/path/rotate_to_path.hpp"

namespace mrpbench::local {

struct MppiOptions {
  int batch_size = 1000, time_steps = 56, iteration_count = 1, retry_attempt_limit = 1, sgf_order = 2;
  double model_dt = 0.05, temperature = 0.3, gamma = 0.015, vx_std = 0.2, wz_std = 0.4;
  double vx_max = 0.5, vx_min = -0.35, wz_max = 1.9, ax_max = 3, ax_min = -3, az_max = 3.5;
  double prune_distance = 2, collision_lookahead_time = 2;
  bool open_loop = false, regenerate_noises = false, clamp_raw_controls = false, roll_noises = true;
  double path_spacing = 0, rotate_to_path = 0.4;
  double min_turning_r = 0, model_delay_vx = 0, model_delay_wz = 0;
  double period = 0.05;

  static Description<MppiOptions> nav2();
  static Description<MppiOptions> further();
  static Description<MppiOptions> derived();
};

class Mppi : public Controller {
 public:
  Mppi(const MppiOptions& options, const RobotOptions& robot, RandomKey key, std::vector<mppi::WeightedCritic> critics);

  std::optional<Twist> command(const Situation& now, const Extra& extra) override;

  /// Every fifth sample and third step as `twist` and `pose`, and their `cost`; of all samples the raw `score`
  /// of each critic, and `total`; the `plan` f8[T,2] of velocities; names of the `critics`; the `reason` why there is
  /// no command. If there is one, the poses of the plan are `chosen` f8[T+1,3], and `chosen_score` has the mean scores
  /// over all samples, weighted as the plan weighs them.
  Explanation explain() const override;

 private:
  std::size_t periods(std::size_t steps) const;
  void recall(double Twist::* axis, std::vector<float>& sent) const;
  std::optional<Twist> decide(const Situation& now, const Extra& extra);
  void draw();
  void reset();
  void prepare(const Situation& now);
  void sample(mppi::Batch& batch) const;
  /// Call `visit()` when a batch is that of a block, for each block.
  template <class Visit>
  void each_block(mppi::Batch& batch, Visit&& visit) const {
    const std::size_t samples = total_.size();
    for (std::size_t first = 0; first < samples; first += mppi::kBlock) {
      const mppi::Lent lent(batch, first / mppi::kBlock, plan_vx_.size(), std::min(mppi::kBlock, samples - first));
      visit();
    }
  }
  template <class Visit>
  void each_deviation(Visit&& visit);
  bool improve(const Extra& extra);
  void begin_plan();
  void score(bool by_furthest);
  bool add_scores(const Extra& extra);
  /// Call `visit(pose)` at the end of each of the first steps of the plan, until it returns false.
  template <class Visit>
  bool walk(std::size_t steps, Visit&& visit) const {
    Pose pose = batch_.robot;
    for (std::size_t t = 0; t < steps; ++t) {
      pose.x += plan_vx_[t] * std::cos(pose.yaw) * options_.model_dt;
      pose.y += plan_vx_[t] * std::sin(pose.yaw) * options_.model_dt;
      pose.yaw += plan_wz_[t] * options_.model_dt;
      if (!visit(pose)) return false;
    }
    return true;
  }
  bool is_safe() const;
  std::vector<double> mean_scores() const;
  Twist send();

  MppiOptions options_;
  RandomKey key_;
  std::vector<mppi::WeightedCritic> critics_;
  bool shift_ = true, drawn_fresh_ = false, scored_ = false;
  std::uint64_t drawn_ = 0;
  Twist start_, last_;
  mppi::Batch batch_;
  std::vector<mppi::Noise> noise_;  // of each block
  std::vector<float> plan_vx_, plan_wz_, total_, raw_, weight_, added_;
  std::vector<char> free_;  // critics for which a sample does not collide
  /// The plan around which samples were drawn last.
  std::vector<float> centre_vx_, centre_wz_;
  std::array<float, 4> past_vx_{}, past_wz_{};
  /// Commands that the drive executes later: in the order in which they were given, and as velocities of the first
  /// steps.
  std::vector<Twist> given_;
  std::vector<float> sent_vx_, sent_wz_;
  std::optional<Pose> goal_;
  RotateToPath rotate_;
  const char* fault_ = "";
};

}  // namespace mrpbench::local
