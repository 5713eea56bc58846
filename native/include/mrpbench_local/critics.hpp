// The critics of Nav2's DWB, by their names, parameters and defaults.
#pragma once

#include "mrpbench_local/critic.hpp"

namespace mrpbench::local {

std::unique_ptr<Critic> rotate_to_goal(CriticOptions& options);
std::unique_ptr<Critic> oscillation(CriticOptions& options);
std::unique_ptr<Critic> base_obstacle(CriticOptions& options);
std::unique_ptr<Critic> obstacle_footprint(CriticOptions& options);
std::unique_ptr<Critic> path_dist(CriticOptions& options);
std::unique_ptr<Critic> goal_dist(CriticOptions& options);
std::unique_ptr<Critic> path_align(CriticOptions& options);
std::unique_ptr<Critic> goal_align(CriticOptions& options);
std::unique_ptr<Critic> prefer_forward(CriticOptions& options);
std::unique_ptr<Critic> twirling(CriticOptions& options);

Aggregation aggregation(CriticOptions& options, Aggregation otherwise);

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
