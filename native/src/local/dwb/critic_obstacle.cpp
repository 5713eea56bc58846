// Costs of trajectories on the costmap: those of the robot's centre, or of the outline of its footprint.
#include <algorithm>

#include "mrpbench_local/costmap/collision.hpp"
#include "mrpbench_local/costmap/footprint.hpp"
#include "mrpbench_local/dwb/critics.hpp"

namespace mrpbench::local {

namespace {

constexpr Reason kOffGrid = "Trajectory Goes Off Grid.";
constexpr Reason kHits = "Trajectory Hits Obstacle.";
constexpr double kOff = -1, kHit = -2;

struct ObstacleOptions {
  bool sum_scores = false;

  static Description<ObstacleOptions> description() {
    return {{"sum_scores", &ObstacleOptions::sum_scores, "sum the costs of all poses instead of taking the last"}};
  }
};

/// `PoseScore` is negative for illegal poses.
template <class PoseScore>
class Obstacle : public Critic {
 public:
  using Options = ObstacleOptions;
  explicit Obstacle(const Options& options) : sum_(options.sum_scores) {}

  bool score(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason> why) override {
    if (sum_) {
      for (std::size_t i = 0; i < all.size(); ++i) raw[i] = sum(scene, all, i);
    } else {
      score_.ends(scene, all, raw);
    }
    return some_illegal(raw, why);
  }

  bool complete(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason> why) override {
    return !sum_ && score_.complete(scene, all, raw) && some_illegal(raw, why);
  }

  Reason check_end(const Scene& scene, Pose pose) override { return sum_ ? kLegal : check(scene, pose); }

  Reason check(const Scene& scene, Pose pose) override {
    const double score = score_(*scene.costmap, pose);
    return score < 0 ? reason(score) : kLegal;
  }

 private:
  static bool some_illegal(std::span<const double> raw, std::span<Reason> why) {
    if (std::ranges::none_of(raw, [](double score) { return score < 0; })) return false;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      if (raw[i] < 0) why[i] = reason(raw[i]);
    }
    return true;
  }

  static Reason reason(double score) { return score == kOff ? kOffGrid : kHits; }

  double sum(const Scene& scene, const Trajectories& all, std::size_t i) {
    double total = 0;
    all.walk(i, [&](Pose pose) {
      const double score = score_(*scene.costmap, pose);
      total = score < 0 ? score : total + score;
      return score >= 0;
    });
    return total;
  }

  PoseScore score_;
  bool sum_;
};

struct Centre {
  double operator()(const Costmap& costmap, Pose pose) const {
    return at(costmap, costmap.frame().cell({pose.x, pose.y}), pose);
  }

  /// The costs of the last poses; whether there is room is asked only of trajectories that could win.
  void ends(const Scene& scene, const Trajectories&, std::span<double> raw) const {
    const EndCells::Cells& cells = scene.ends->ahead(0);
    const Costmap& costmap = *scene.costmap;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const Cell c{cells.x[i], cells.y[i]};
      if (!cells.inside && !costmap.frame().holds(c)) {
        raw[i] = kOff;
      } else {
        raw[i] = costmap.at(c) <= kInscribed ? costmap.at(c) : kHit;
      }
    }
  }

  bool complete(const Scene& scene, const Trajectories& all, std::span<double> raw) const {
    const EndCells::Cells& cells = scene.ends->ahead(0);
    for (std::size_t i = 0; i < raw.size(); ++i) {
      if (raw[i] >= 0) raw[i] = at(*scene.costmap, {cells.x[i], cells.y[i]}, all.end(i));
    }
    return true;
  }

 private:
  static double at(const Costmap& costmap, Cell c, Pose pose) {
    if (!costmap.frame().holds(c)) return kOff;
    return costmap.is_free(c, {pose.x, pose.y}) ? costmap.at(c) : kHit;
  }
};

/// The highest cost along the outline.
struct Outline {
  std::vector<Point> corners;

  double operator()(const Costmap& costmap, Pose pose) {
    const Frame& frame = costmap.frame();
    if (!frame.holds(frame.cell({pose.x, pose.y}))) return kOff;
    place(costmap.options().footprint, pose, corners);
    const auto worst = outline_cost(costmap, corners);
    if (!worst) return kOff;
    return *worst >= kLethal ? kHit : *worst;
  }

  void ends(const Scene& scene, const Trajectories& all, std::span<double> raw) {
    for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = (*this)(*scene.costmap, all.end(i));
  }

  bool complete(const Scene&, const Trajectories&, std::span<double>) const { return false; }
};

}  // namespace

CriticKind base_obstacle() {
  return kind_of<Obstacle<Centre>>();
}

CriticKind obstacle_footprint() {
  return kind_of<Obstacle<Outline>>();
}

}  // namespace mrpbench::local
