// Nav2's DWB: the velocity whose trajectory has the best score of its critics. Written from Nav2's documentation
// (navigation.ros.org, "DWB Controller") and parameters.
#pragma once

#include <functional>
#include <optional>

#include "mrpbench_local/critic.hpp"

namespace mrpbench::local {

struct DwbOptions {
  MotionOptions motion;
  Pruning pruning;
  double min_x_velocity_threshold = 0.001, min_theta_velocity_threshold = 0.001;
  bool short_circuit = true;
  double rotate_to_path = 0.4;

  /// The parameters of Nav2.
  static Description<DwbOptions> nav2();
  /// Options that Nav2 does not have.
  static Description<DwbOptions> further();
};

/// A path in the plane, with yaw and speed at its end.
struct Path {
  Point first;
  std::span<const Point> rest;
  double yaw = 0, speed = 0, tolerance = 0.1;
};

class Dwb {
 public:
  struct Weighted {
    std::string name;
    double scale = 1;
    std::unique_ptr<Critic> critic;
  };
  /// Scores that the caller adds; infinity = illegal.
  using Extra = std::function<void(const Trajectories&, std::span<double>)>;

  Dwb(const DwbOptions& options, std::vector<Weighted> critics);

  /// The best command, or nothing when all are illegal.
  std::optional<Twist> command(double now, Pose pose, Twist twist, const Path& path, const Costmap& costmap,
                               const Extra& extra = {});

  // The trajectories from which the last command was chosen.
  const Trajectories& trajectories() const { return all_; }
  /// Totals; those of trajectories that are illegal or were not fully checked are partial.
  const std::vector<double>& totals() const { return total_; }
  /// Why trajectories were dropped, and by which critic (-1 = by none); parallel to the trajectories.
  const std::vector<Reason>& reasons() const { return why_; }
  const std::vector<int>& droppers() const { return dropped_; }
  const std::vector<Weighted>& critics() const { return critics_; }
  /// Raw scores of each critic, row by row.
  const std::vector<double>& scores() const { return raw_; }

 private:
  std::optional<Twist> turn_first(Pose pose, const Path& path, const Costmap& costmap);
  void score(const Scene& scene, const Extra& extra);
  bool passes(const Scene& scene, std::size_t i);
  std::optional<std::size_t> best(const Scene& scene);

  DwbOptions options_;
  std::vector<Weighted> critics_;
  Trajectories all_;
  PathGrid path_;
  std::optional<Pose> goal_;
  bool turning_ = false;
  std::vector<double> raw_, total_;
  std::vector<Reason> why_, fault_;
  std::vector<int> dropped_;
  std::vector<std::size_t> order_;
};

}  // namespace mrpbench::local
