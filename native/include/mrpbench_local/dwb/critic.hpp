// Critics score trajectories.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "mrpbench_local/costmap/costmap.hpp"
#include "mrpbench_local/dwb/trajectories.hpp"
#include "mrpbench_local/forecast.hpp"
#include "mrpbench_local/path/path_grid.hpp"

namespace mrpbench::local {

/// The input of critics: state of the robot, goal and costmap.
struct Scene {
  double now = 0;
  Pose pose;
  Twist twist;
  /// Where its path ends; yaw NaN = any.
  Pose goal;
  /// Metres from the goal at which it counts as reached.
  double tolerance = 0.1;
  const Costmap* costmap = nullptr;
  const PathGrid* path = nullptr;
  EndCells* ends = nullptr;
  const Forecast* forecast = nullptr;
};

/// Why a trajectory must not be driven; empty = it may.
using Reason = const char*;
constexpr Reason kLegal = nullptr;

/// How the poses of a trajectory make one score.
enum class Aggregation { last, sum, product };

class Critic {
 public:
  virtual ~Critic() = default;

  /// Start a new path.
  virtual void reset() {}
  /// Prepare for a scene.
  virtual void prepare(const Scene&) {}
  /// Raw scores of all trajectories, lower is better, and why some are illegal; `why` comes full of `kLegal`. Tells
  /// whether some may be.
  virtual bool score(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason> why) = 0;
  /// Score again what `score` took for legal until it is known which trajectories could win, in the same way. Tells
  /// whether some are illegal.
  virtual bool complete(const Scene&, const Trajectories&, std::span<double>, std::span<Reason>) { return false; }
  /// What `complete` would say of one trajectory.
  virtual Reason check_end(const Scene&, const Trajectories&, std::size_t) { return kLegal; }
  /// Check one pose of a trajectory; called only for trajectories that could win.
  virtual Reason check(const Scene&, Pose) { return kLegal; }
  /// Record the command that was chosen.
  virtual void debrief(const Scene&, Twist) {}
  /// Metres ahead of the last poses at which it asks how far the path is.
  virtual double looks_ahead() const { return 0; }
  /// Factor of the scale; 0 = nothing to say, and trajectories are not scored.
  virtual double weight(const Scene&) const { return 1; }
};

/// The critics of one name.
struct CriticKind {
  std::function<std::unique_ptr<Critic>(const OptionValues&)> make;
  std::vector<Parameter> options;
};

/// The critics that Nav2 calls by this name. Throws std::invalid_argument if there are none.
const CriticKind& critic_kind(std::string_view name);

/// A critic by Nav2's name. Throws std::invalid_argument, naming critic and option, for an option that does not exist
/// or that cannot have its value.
std::unique_ptr<Critic> make_critic(std::string_view name, const OptionValues& options);

}  // namespace mrpbench::local
