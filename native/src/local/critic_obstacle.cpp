// What trajectories cost on the costmap: of the robot's centre, or of the outline of its footprint.
#include <algorithm>

#include "mrpbench_local/critics.hpp"
#include "mrpbench_local/footprint.hpp"

namespace mrpbench::local {

namespace {

constexpr Reason kOffGrid = "Trajectory Goes Off Grid.";
constexpr Reason kHits = "Trajectory Hits Obstacle.";
constexpr double kOff = -1, kHit = -2;

/// Scores poses, negative where they are illegal.
template <class PoseScore>
class Obstacle : public Critic {
 public:
  Obstacle(PoseScore score, bool sum) : score_(std::move(score)), sum_(sum) {}

  void score(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason> why) override {
    for (std::size_t i = 0; i < all.size(); ++i) {
      raw[i] = sum_ ? sum(scene, all, i) : score_(*scene.costmap, all.end(i));
      if (raw[i] < 0) why[i] = raw[i] == kOff ? kOffGrid : kHits;
    }
  }

  Reason check(const Scene& scene, const Trajectories& all, std::size_t i) override {
    double worst = 0;
    all.walk(i, [&](Pose pose) {
      worst = score_(*scene.costmap, pose);
      return worst >= 0;
    });
    return worst >= 0 ? kLegal : worst == kOff ? kOffGrid : kHits;
  }

 private:
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
    const Cell c = costmap.frame().cell({pose.x, pose.y});
    if (!costmap.frame().holds(c)) return kOff;
    const std::uint8_t cost = costmap.at(c);
    return cost >= kInscribed ? kHit : cost;
  }
};

/// The highest cost along the outline.
struct Outline {
  std::vector<Point> corners;

  double operator()(const Costmap& costmap, Pose pose) {
    const Frame& frame = costmap.frame();
    if (!frame.holds(frame.cell({pose.x, pose.y}))) return kOff;
    place(costmap.options().footprint, pose, corners);
    for (const Point& p : corners) {
      if (!frame.holds(frame.cell(p))) return kOff;
    }
    std::uint8_t worst = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      line(frame.cell(corners[i]), frame.cell(corners[(i + 1) % corners.size()]), [&](Cell c) {
        worst = std::max(worst, costmap.at(c));
        return true;
      });
    }
    return worst >= kLethal ? kHit : worst;
  }
};

}  // namespace

std::unique_ptr<Critic> base_obstacle(CriticOptions& options) {
  return std::make_unique<Obstacle<Centre>>(Centre{}, options.take("sum_scores", 0) != 0);
}

std::unique_ptr<Critic> obstacle_footprint(CriticOptions& options) {
  return std::make_unique<Obstacle<Outline>>(Outline{}, options.take("sum_scores", 0) != 0);
}

}  // namespace mrpbench::local
