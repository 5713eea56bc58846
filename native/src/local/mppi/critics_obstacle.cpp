// Critics that keep samples away from obstacles.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mrpbench_local/costmap/collision.hpp"
#include "mrpbench_local/costmap/footprint.hpp"
#include "mrpbench_local/mppi/critic.hpp"
#include "mrpbench_local/wide.hpp"

namespace mrpbench::local::mppi {

namespace {

/// The costs under poses that are given in the frame of the robot.
class Lookup {
 public:
  static constexpr int kOff = -1;

  Lookup(const Batch& batch, bool consider_footprint) : batch_(batch), map_(*batch.costmap) {
    const Frame& frame = map_.frame();
    const double per = 1 / frame.resolution;
    cosine_ = static_cast<float>(std::cos(batch.robot.yaw) * per);
    sine_ = static_cast<float>(std::sin(batch.robot.yaw) * per);
    x_ = static_cast<float>(batch.robot.x * per - frame.origin.x);
    y_ = static_cast<float>(batch.robot.y * per - frame.origin.y);
    outline_ = consider_footprint && !batch.by_radius;
    double farthest = 0;
    for (const Point& p : map_.options().footprint) farthest = std::max(farthest, sim::length(p));
    near_ = outline_ ? inflated_cost(farthest, map_.inscribed(), map_.options().cost_scaling_factor) : kInscribed;
  }

  /// The indices of the cells that hold places, -1 outside of the map.
  MRPBENCH_WIDE void find(std::span<const float> px, const float* py, std::int32_t* index) const {
    const float cosine = cosine_, sine = sine_, left = x_, bottom = y_;
    const std::int32_t width = map_.frame().width, height = map_.frame().height;
    for (std::size_t k = 0; k < px.size(); ++k) {
      const float u = cosine * px[k] - sine * py[k] + left, v = sine * px[k] + cosine * py[k] + bottom;
      const auto column = static_cast<std::int32_t>(u), row = static_cast<std::int32_t>(v);
      const bool outside = (u < 0) | (v < 0) | (column >= width) | (row >= height);
      index[k] = outside ? -1 : row * width + column;
    }
  }

  /// The cost of a cell, or `kOff`.
  int at(std::int32_t index) const { return index < 0 ? kOff : map_.costs()[static_cast<std::size_t>(index)]; }

  /// Tell whether the robot collides at a pose, under which the cost is `cost`.
  bool collides(int cost, float px, float py, float yaw) {
    if (cost < near_) return cost == kOff;
    if (cost >= kLethal) return true;
    const Pose pose = batch_.in_map(px, py, yaw);
    if (!outline_) {
      const Cell c = map_.frame().cell({pose.x, pose.y});
      return map_.frame().holds(c) && !map_.is_free(c, {pose.x, pose.y});
    }
    place(map_.options().footprint, pose, corners_);
    return outline_cost(map_, corners_).value_or(kLethal) >= kLethal;
  }

  bool by_outline() const { return outline_; }

 private:
  const Batch& batch_;
  const Costmap& map_;
  float cosine_, sine_, x_, y_;
  bool outline_;
  int near_;
  std::vector<Point> corners_;
};

/// Go through every `step`th pose of all samples: `score(k, cost)` for costs above 0, up to the collision of a sample,
/// which makes its score `collision`. Returns false if every sample collides.
template <class Score>
bool sweep(const Batch& batch, Lookup& costs, std::size_t step, double collision, std::span<float> raw, Score&& score) {
  std::vector<char> collides(raw.size(), 0);
  std::vector<std::int32_t> cells(raw.size());
  std::size_t left = raw.size();
  for (std::size_t t = 0; t < batch.steps(); t += step) {
    const float *x = batch.x[t], *y = batch.y[t], *yaw = batch.yaw[t];
    costs.find({x, raw.size()}, y, cells.data());
    for (std::size_t k = 0; k < raw.size(); ++k) {
      const int cost = costs.at(cells[k]);
      if (cost == 0 || collides[k]) continue;
      if (costs.collides(cost, x[k], y[k], yaw[k])) {
        collides[k] = 1;
        raw[k] = static_cast<float>(collision);
        --left;
      } else {
        score(k, cost);
      }
    }
  }
  return left > 0;
}

/// Mean cost under the poses.
class Cost : public Critic {
 public:
  struct Options : Weighting {
    double critical_cost = 300, collision_cost = 1e6, near_goal_distance = 0.5;
    int near_collision_cost = 253, trajectory_point_step = 2;
    bool consider_footprint = false;
    static Description<Options> description() {
      return {{"critical_cost", &Options::critical_cost, at_least(0), "score of a pose at near_collision_cost or more"},
              {"collision_cost", &Options::collision_cost, at_least(0), "score of a sample that collides"},
              {"near_goal_distance", &Options::near_goal_distance, at_least(0, "m"),
               "only collisions count when less of the path is left"},
              {"near_collision_cost", &Options::near_collision_cost, within(0, 254),
               "cost from which on poses are critical"},
              {"trajectory_point_step", &Options::trajectory_point_step, at_least(1), "look at every so many poses"},
              {"consider_footprint", &Options::consider_footprint,
               "check the outline of robots that are no discs, instead of their centre"}};
    }
  };
  explicit Cost(const Options& options) : options_(options) {}

  bool score(const Batch& batch, std::span<float> raw) override {
    Lookup costs(batch, options_.consider_footprint);
    const auto step = static_cast<std::size_t>(options_.trajectory_point_step);
    const bool near_goal = batch.path.length < static_cast<float>(options_.near_goal_distance);
    const auto critical = static_cast<float>(options_.critical_cost);
    const bool some = sweep(batch, costs, step, options_.collision_cost, raw, [&](std::size_t k, int cost) {
      if (cost >= options_.near_collision_cost) {
        raw[k] += critical;
      } else if (!near_goal) {
        raw[k] += static_cast<float>(cost);
      }
    });
    const float share = 1.0f / 254.0f / static_cast<float>((batch.steps() + step - 1) / step);
    for (float& it : raw) it *= share;
    return some;
  }

 private:
  Options options_;
};

/// Repulsion by the distance of obstacles, which follows from the cost.
class Obstacles : public Critic {
 public:
  struct Options : Weighting {
    double repulsion_weight = 1.5, critical_weight = 20, collision_cost = 1e5, collision_margin_distance = 0.1;
    double near_goal_distance = 0.5;
    bool consider_footprint = false;
    static Description<Options> description() {
      return {{"repulsion_weight", &Options::repulsion_weight, at_least(0), "weight of the distance"},
              {"critical_weight", &Options::critical_weight, at_least(0), "weight of what is nearer than the margin"},
              {"collision_cost", &Options::collision_cost, at_least(0), "score of a sample that collides"},
              {"collision_margin_distance", &Options::collision_margin_distance, at_least(0, "m"), "that margin"},
              {"near_goal_distance", &Options::near_goal_distance, at_least(0, "m"),
               "no repulsion beyond the margin when less of the path is left"},
              {"consider_footprint", &Options::consider_footprint,
               "check the outline of robots that are no discs, instead of their centre"}};
    }
  };
  explicit Obstacles(const Options& options) : options_(options) {}

  bool score(const Batch& batch, std::span<float> raw) override {
    Lookup costs(batch, options_.consider_footprint);
    const CostmapOptions& map = batch.costmap->options();
    const float inflation = static_cast<float>(map.inflation_radius);
    const float inscribed = static_cast<float>(batch.costmap->inscribed());
    const bool near_goal = batch.path.length < static_cast<float>(options_.near_goal_distance);
    float distance[256];  // of obstacles, by cost
    for (int cost = 1; cost < 256; ++cost) {
      const double away = (std::log(253.0) - std::log(cost)) / map.cost_scaling_factor;
      distance[cost] = static_cast<float>(away) + (costs.by_outline() ? inscribed : 0.0f);
    }
    repulsion_.assign(raw.size(), 0);
    const auto margin = static_cast<float>(options_.collision_margin_distance);
    const bool some = sweep(batch, costs, 1, options_.collision_cost, raw, [&](std::size_t k, int cost) {
      const float away = distance[cost];
      if (away < margin) raw[k] += margin - away;
      if (!near_goal) repulsion_[k] += std::max(inflation - away, 0.0f);
    });
    const float least = *std::min_element(repulsion_.begin(), repulsion_.end());
    const float share = static_cast<float>(options_.repulsion_weight) / static_cast<float>(batch.steps());
    for (std::size_t k = 0; k < raw.size(); ++k) {
      raw[k] = static_cast<float>(options_.critical_weight) * raw[k] + share * (repulsion_[k] - least);
    }
    return some;
  }

 private:
  Options options_;
  std::vector<float> repulsion_;
};

}  // namespace

CriticKind cost_critic() {
  return kind_of<Cost>(3.81);
}

CriticKind obstacles_critic() {
  return kind_of<Obstacles>(1);
}

}  // namespace mrpbench::local::mppi
