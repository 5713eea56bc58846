// Critics score trajectories.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "mrpbench_local/costmap.hpp"
#include "mrpbench_local/path_grid.hpp"
#include "mrpbench_local/trajectories.hpp"

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
};

/// Why a trajectory must not be driven; empty = it may.
using Reason = const char*;
constexpr Reason kLegal = nullptr;

/// How the poses of a trajectory make one score.
enum class Aggregation { last, sum, product };

/// Options by Nav2's names; a critic takes its own; the remaining ones are errors.
class CriticOptions {
 public:
  explicit CriticOptions(std::map<std::string, double> values) : values_(std::move(values)) {}
  double take(const std::string& name, double otherwise) {
    const auto found = values_.find(name);
    if (found == values_.end()) return otherwise;
    const double value = found->second;
    values_.erase(found);
    return value;
  }
  void finish() const {
    if (!values_.empty()) throw std::invalid_argument("unknown option of a critic: " + values_.begin()->first);
  }

 private:
  std::map<std::string, double> values_;
};

class Critic {
 public:
  virtual ~Critic() = default;

  /// Start a new path.
  virtual void reset() {}
  /// Prepare for a scene.
  virtual void prepare(const Scene&) {}
  /// Raw scores of all trajectories, lower is better, and why some are illegal; `why` comes full of `kLegal`.
  virtual void score(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason> why) = 0;
  /// Check one pose of a trajectory; called only for trajectories that could win.
  virtual Reason check(const Scene&, Pose) { return kLegal; }
  /// Record the command that was chosen.
  virtual void debrief(const Scene&, Twist) {}
  /// Factor of the scale.
  virtual double weight(const Scene&) const { return 1; }
};

/// A critic by Nav2's name.
std::unique_ptr<Critic> make_critic(std::string_view name, std::map<std::string, double> options);

}  // namespace mrpbench::local
