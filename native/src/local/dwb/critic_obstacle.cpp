// Costs of trajectories on the costmap: those of the robot's centre, or of the outline of its footprint.
#include <algorithm>

#include "mrpbench_common/wide.hpp"
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

/// Tells whether some are illegal.
MRPBENCH_WIDE bool look_up(std::size_t count, const int* x, const int* y, int width, const std::uint8_t* costs,
                           double* raw) {
  unsigned hits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t cost = costs[y[i] * width + x[i]];
    raw[i] = cost <= kInscribed ? cost : kHit;
    hits |= cost > kInscribed;
  }
  return hits != 0;
}

/// `PoseScore` is negative for illegal poses.
template <class PoseScore>
class Obstacle : public Critic {
 public:
  using Options = ObstacleOptions;
  explicit Obstacle(const Options& options) : sum_(options.sum_scores) {}

  bool score(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason> why) override {
    if (!sum_) return score_.ends(scene, all, raw) && some_illegal(raw, why);
    for (std::size_t i = 0; i < all.size(); ++i) raw[i] = sum(scene, all, i);
    return some_illegal(raw, why);
  }

  bool complete(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason> why) override {
    return !sum_ && score_.complete(scene, all, raw) && some_illegal(raw, why);
  }

  Reason check_end(const Scene& scene, const Trajectories& all, std::size_t i) override {
    return sum_ || score_.is_clear(scene, i) ? kLegal : check(scene, all.end(i));
  }

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

  /// The costs of the last poses; whether there is room is asked only of trajectories that could win. Tells whether
  /// some may be illegal.
  bool ends(const Scene& scene, const Trajectories&, std::span<double> raw) const {
    const EndCells::Cells& cells = scene.ends->ahead(0);
    const Costmap& costmap = *scene.costmap;
    if (cells.inside) {
      return look_up(raw.size(), cells.x.data(), cells.y.data(), costmap.frame().width, costmap.costs().data(),
                     raw.data());
    }
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const Cell c{cells.x[i], cells.y[i]};
      raw[i] = !costmap.frame().holds(c) ? kOff : costmap.at(c) <= kInscribed ? costmap.at(c) : kHit;
    }
    return true;
  }

  bool complete(const Scene& scene, const Trajectories& all, std::span<double> raw) const {
    const EndCells::Cells& cells = scene.ends->ahead(0);
    all.compute_ends();
    for (std::size_t i = 0; i < raw.size(); ++i) {
      if (raw[i] >= 0) raw[i] = at(*scene.costmap, {cells.x[i], cells.y[i]}, all.end(i));
    }
    return true;
  }

  /// Tell whether there is room wherever in its cell a trajectory ends.
  bool is_clear(const Scene& scene, std::size_t i) const {
    const EndCells::Cells& cells = scene.ends->ahead(0);
    const Cell c{cells.x[i], cells.y[i]};
    return scene.costmap->frame().holds(c) && scene.costmap->is_clear(c);
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

  bool ends(const Scene& scene, const Trajectories& all, std::span<double> raw) {
    all.compute_ends();
    for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = (*this)(*scene.costmap, all.end(i));
    return true;
  }

  bool complete(const Scene&, const Trajectories&, std::span<double>) const { return false; }
  bool is_clear(const Scene&, std::size_t) const { return false; }
};

}  // namespace

CriticKind base_obstacle() {
  return kind_of<Obstacle<Centre>>();
}

CriticKind obstacle_footprint() {
  return kind_of<Obstacle<Outline>>();
}

}  // namespace mrpbench::local
