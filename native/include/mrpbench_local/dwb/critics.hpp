// The critics of Nav2's DWB, by their names, parameters and defaults.
#pragma once

#include "mrpbench_local/dwb/critic.hpp"

namespace mrpbench::local {

CriticKind rotate_to_goal();
CriticKind oscillation();
CriticKind base_obstacle();
CriticKind obstacle_footprint();
CriticKind path_dist();
CriticKind goal_dist();
CriticKind path_align();
CriticKind goal_align();
CriticKind prefer_forward();
CriticKind twirling();
CriticKind predicted_obstacle();

/// Critics of the class `C`, which is made from `C::Options`.
template <class C>
CriticKind kind_of() {
  using Options = typename C::Options;
  return {[](const OptionValues& values) -> std::unique_ptr<Critic> {
            return std::make_unique<C>(configured(Options::description(), values, Options{}));
          },
          parameters(Options::description(), Options{})};
}

/// The scores of one trajectory's poses as one. `pose_score(pose)` gives a negative number for what is off the map.
template <class PoseScore>
double aggregate(Aggregation how, const Trajectories& all, std::size_t i, PoseScore&& pose_score) {
  if (how == Aggregation::last) return pose_score(all.end(i));
  double total = how == Aggregation::sum ? 0 : 1;
  bool fits = true;
  all.walk(i, [&](Pose pose) {
    const double score = pose_score(pose);
    fits = score >= 0;
    if (how == Aggregation::sum) total += score;
    if (how == Aggregation::product && total > 0) total *= score;
    return fits;
  });
  return fits ? total : -1;
}

}  // namespace mrpbench::local
