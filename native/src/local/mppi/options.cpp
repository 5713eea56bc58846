// The options of MPPI by the names, defaults and limits of Nav2, and the controllers that are made from them.
#include <stdexcept>

#include "mrpbench_local/mppi/mppi.hpp"

namespace mrpbench::local {

Description<MppiOptions> MppiOptions::nav2() {
  using M = MppiOptions;
  return {{"batch_size", &M::batch_size, within(1, 100000).usually(500, 2000), "number of samples"},
          {"time_steps", &M::time_steps, within(2, 1000), "steps of a sample"},
          {"model_dt", &M::model_dt, within(0.001, 10, "s"), "duration of a step; not shorter than the control period"},
          {"iteration_count", &M::iteration_count, within(1, 100), "updates per period"},
          {"temperature", &M::temperature, above(0).usually(0.1, 0.5),
           "how much worse samples count less; small = the best alone"},
          {"gamma", &M::gamma, at_least(0).usually(0.005, 0.05), "how much controls far from the last ones cost"},
          {"vx_std", &M::vx_std, above(0, "m/s").usually(0.1, 0.4), "standard deviation of sampled speeds"},
          {"wz_std", &M::wz_std, above(0, "rad/s").usually(0.2, 0.8), "standard deviation of sampled turn rates"},
          {"vx_max", &M::vx_max, above(0, "m/s"), "highest speed, within the robot's limit"},
          {"vx_min", &M::vx_min, any("m/s"), "lowest speed, within the robot's limit; negative = may drive back"},
          {"wz_max", &M::wz_max, above(0, "rad/s"), "highest turn rate, within the robot's limit"},
          {"ax_max", &M::ax_max, above(0), "acceleration, within the robot's limit, m/s^2"},
          {"ax_min", &M::ax_min, any(""), "deceleration, negative, m/s^2"},
          {"az_max", &M::az_max, above(0), "acceleration of turns, within the robot's limit, rad/s^2"},
          {"prune_distance", &M::prune_distance, above(0, "m").usually(1, 3), "ignore the path that is farther along"},
          {"retry_attempt_limit", &M::retry_attempt_limit, within(0, 100), "new attempts when all samples collide"},
          {"open_loop", &M::open_loop, "start from the last command instead of the measured velocity"},
          {"regenerate_noises", &M::regenerate_noises, "draw new noise in every period"},
          {"clamp_raw_controls", &M::clamp_raw_controls, "limit sampled controls by the accelerations, too"},
          {"min_turning_r", &M::min_turning_r, at_least(0, "m"),
           "smallest radius of turns, of Ackermann steering; 0 = the robot turns on the spot"},
          {"model_delay_vx", &M::model_delay_vx, at_least(0, "s"),
           "samples begin with the speeds that were commanded so long ago"},
          {"model_delay_wz", &M::model_delay_wz, at_least(0, "s"),
           "samples begin with the turn rates that were commanded so long ago"},
          {"sgf_order", &M::sgf_order, within(1, 2), "order of the filter that smooths the controls"},
          {"collision_lookahead_time", &M::collision_lookahead_time, above(0, "s").usually(1, 3),
           "check the command for collisions up to this time"}};
}

Description<MppiOptions> MppiOptions::further() {
  using M = MppiOptions;
  return {
      {"path_spacing", &M::path_spacing, within(0, 10, "m"),
       "distance of the points of the path that critics count; 0 = so that as many are within reach as at Nav2's "
       "highest speed and spacing"},
      {"roll_noises", &M::roll_noises,
       "begin one step later in the noise in every period, so that a robot does not stand where the plan and always "
       "the same noise balance; false = as Nav2 without regenerate_noises"},
      {"rotate_to_path", &M::rotate_to_path, at_least(0),
       "turn on the spot first where a new path leads off the heading by more than this, radians, as the rotation "
       "shim of Nav2 does; 0 = never, as MPPI alone; Ackermann steering never does"}};
}

Description<MppiOptions> MppiOptions::derived() {
  return {{"period", &MppiOptions::period, above(0, "s"), "control period"}};
}

ControllerKind mppi_controller() {
  Description<MppiOptions> rows = MppiOptions::nav2();
  for (const auto& group : {MppiOptions::further(), MppiOptions::derived()}) {
    rows.insert(rows.end(), group.begin(), group.end());
  }
  ControllerKind kind;
  kind.make = [rows](const OptionValues& values, const RobotOptions& robot, RandomKey key,
                     std::span<const CriticChoice> chosen) {
    std::vector<mppi::WeightedCritic> critics;
    for (const CriticChoice& it : chosen) {
      try {
        critics.push_back(mppi::critic_kind(it.name).make(it.options));
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(it.name + ": " + error.what());
      }
      critics.back().name = it.name;
    }
    return std::make_unique<Mppi>(configured(rows, values, MppiOptions{}), robot, key, std::move(critics));
  };
  kind.nav2 = parameters(MppiOptions::nav2());
  kind.further = parameters(MppiOptions::further());
  kind.derived = parameters(MppiOptions::derived());
  kind.critic_options = [](const std::string& name) { return mppi::critic_kind(name).options; };
  return kind;
}

}  // namespace mrpbench::local
