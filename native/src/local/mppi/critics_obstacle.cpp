// Critics that keep samples away from obstacles.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "local/next_byte.hpp"
#include "mrpbench_common/wide.hpp"
#include "mrpbench_local/costmap/collision.hpp"
#include "mrpbench_local/costmap/footprint.hpp"
#include "mrpbench_local/mppi/critic.hpp"

namespace mrpbench::local::mppi {

namespace {

/// What critics need for a while, shared by the robots that a thread controls one after the other.
struct Buffers {
  /// The costs of all cells as numbers that vectors can gather, and at the end `kOff`.
  std::vector<float> costs;
  /// Of one step of all samples: the cell that holds each, its cost, and 1 where the robot may collide.
  std::vector<std::int32_t> cell;
  std::vector<float> row;
  std::vector<char> suspect;
  std::vector<char> collides;

  static Buffers& of_thread() {
    thread_local Buffers buffers;
    return buffers;
  }
};

/// The costs under poses that are given in the frame of the robot.
class Lookup {
 public:
  static constexpr float kOff = -1;

  Lookup(const Batch& batch, bool consider_footprint, Buffers& its) : batch_(batch), map_(*batch.costmap), its_(its) {
    const Frame& frame = map_.frame();
    const double per = 1 / frame.resolution;
    cosine_ = static_cast<float>(batch.heading.x * per);
    sine_ = static_cast<float>(batch.heading.y * per);
    x_ = static_cast<float>(batch.robot.x * per - frame.origin.x);
    y_ = static_cast<float>(batch.robot.y * per - frame.origin.y);
    outline_ = consider_footprint && !batch.by_radius;
    double farthest = 0;
    for (const Point& p : map_.options().footprint) farthest = std::max(farthest, sim::length(p));
    near_ = outline_ ? inflated_cost(farthest, map_.inscribed(), map_.options().cost_scaling_factor) : kInscribed;
    its_.cell.resize(batch.samples());
    its_.row.resize(batch.samples());
    its_.suspect.resize(batch.samples());
  }

  /// Look costs up in this costmap.
  static void begin(const Costmap& map, Buffers& its) {
    its.costs.assign(map.costs().begin(), map.costs().end());
    its.costs.push_back(kOff);
  }

  /// Fill the row of step t, and the suspects if there are some. Returns whether there are.
  MRPBENCH_WIDE bool find(std::size_t t) {
    const float cosine = cosine_, sine = sine_, left = x_, bottom = y_, near = static_cast<float>(near_);
    const std::int32_t width = map_.frame().width, height = map_.frame().height, off = width * height;
    const float *const px = batch_.x[t], *const py = batch_.y[t], *const costs = its_.costs.data();
    float* const row = its_.row.data();
    std::int32_t* const cell = its_.cell.data();
    char* const suspect = its_.suspect.data();
    const std::size_t count = its_.row.size();
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < count; ++k) {
      const float u = cosine * px[k] - sine * py[k] + left, v = sine * px[k] + cosine * py[k] + bottom;
      const auto column = static_cast<std::int32_t>(u), line = static_cast<std::int32_t>(v);
      const bool outside = (u < 0) | (v < 0) | (column >= width) | (line >= height);
      cell[k] = outside ? off : line * width + column;
    }
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < count; ++k) row[k] = costs[cell[k]];
    std::int32_t some = 0;
    for (std::size_t k = 0; k < count; ++k) some |= (row[k] < 0) | (row[k] >= near) ? 1 : 0;
    if (some == 0) return false;
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < count; ++k) suspect[k] = (row[k] < 0) | (row[k] >= near) ? 1 : 0;
    return true;
  }

  /// Tell whether the robot collides at the pose of a sample, which is a suspect.
  bool collides(std::size_t t, std::size_t k) {
    const float cost = its_.row[k];
    if (cost == kOff || cost >= kLethal) return true;
    const Pose pose = batch_.in_map(batch_.x[t][k], batch_.y[t][k], batch_.yaw[t][k]);
    if (!outline_) {
      const Cell c = map_.frame().cell({pose.x, pose.y});
      return map_.frame().holds(c) && !map_.is_free(c, {pose.x, pose.y});
    }
    place(map_.options().footprint, pose, corners_);
    return outline_cost(map_, corners_).value_or(kLethal) >= kLethal;
  }

 private:
  const Batch& batch_;
  const Costmap& map_;
  Buffers& its_;
  float cosine_, sine_, x_, y_;
  bool outline_;
  int near_;
  std::vector<Point> corners_;
};

/// Go through every `step`th pose of all samples: `score(costs, collides)` with the cost under each sample, and which
/// have collided so far. In the end these score `collision`. Returns false if every sample collides.
template <class Score>
bool sweep(const Batch& batch, Lookup& costs, Buffers& its, std::size_t step, double collision, std::span<float> raw,
           Score&& score) {
  its.collides.assign(raw.size(), 0);
  std::size_t left = raw.size();
  for (std::size_t t = 0; t < batch.steps(); t += step) {
    const bool some = costs.find(t);
    for (std::size_t k = some ? 0 : raw.size(); (k = next_byte(its.suspect.data(), 1, k, raw.size())) < raw.size();
         ++k) {
      if (its.collides[k] || !costs.collides(t, k)) continue;
      its.collides[k] = 1;
      --left;
    }
    score(its.row.data(), its.collides.data());
  }
  for (std::size_t k = 0; k < raw.size(); ++k) {
    if (its.collides[k]) raw[k] = static_cast<float>(collision);
  }
  return left > 0;
}

/// Add `critical` for costs from `limit` on, and a share of lower ones.
MRPBENCH_WIDE void add_costs(const float* costs, float limit, float critical, float share, std::span<float> raw) {
  MRPBENCH_NO_OVERLAP
  for (std::size_t k = 0; k < raw.size(); ++k) raw[k] += costs[k] >= limit ? critical : share * costs[k];
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

  void begin(const Batch& batch) override { Lookup::begin(*batch.costmap, Buffers::of_thread()); }

  bool score(const Batch& batch, std::span<float> raw) override {
    Buffers& its = Buffers::of_thread();
    Lookup costs(batch, options_.consider_footprint, its);
    const auto step = static_cast<std::size_t>(options_.trajectory_point_step);
    const bool near_goal = batch.path.length < static_cast<float>(options_.near_goal_distance);
    const auto critical = static_cast<float>(options_.critical_cost);
    // Cells that cost nothing are never critical.
    const auto limit = static_cast<float>(std::max(1, options_.near_collision_cost));
    const bool some = sweep(batch, costs, its, step, options_.collision_cost, raw, [&](const float* row, const char*) {
      add_costs(row, limit, critical, near_goal ? 0.0f : 1.0f, raw);
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

  void begin(const Batch& batch) override {
    Lookup::begin(*batch.costmap, Buffers::of_thread());
    const bool by_outline = options_.consider_footprint && !batch.by_radius;
    const auto inscribed = static_cast<float>(batch.costmap->inscribed());
    for (std::size_t cost = 1; cost < 256; ++cost) {
      const double away =
          (std::log(253.0) - std::log(static_cast<double>(cost))) / batch.costmap->options().cost_scaling_factor;
      distance_[cost] = static_cast<float>(away) + (by_outline ? inscribed : 0.0f);
    }
    repulsion_.clear();
  }

  bool score(const Batch& batch, std::span<float> raw) override {
    Buffers& its = Buffers::of_thread();
    Lookup costs(batch, options_.consider_footprint, its);
    const float inflation = static_cast<float>(batch.costmap->options().inflation_radius);
    const bool near_goal = batch.path.length < static_cast<float>(options_.near_goal_distance);
    share_ = static_cast<float>(options_.repulsion_weight) / static_cast<float>(batch.steps());
    repulsion_.resize(batch.first + raw.size(), 0);
    float* const repulsion = &repulsion_[batch.first];
    const auto margin = static_cast<float>(options_.collision_margin_distance);
    const auto repel = [&](const float* row, const char* collides) {
      for (std::size_t k = 0; k < raw.size(); ++k) {
        if (row[k] == 0 || collides[k]) continue;
        const float away = distance_[static_cast<std::size_t>(row[k])];
        if (away < margin) raw[k] += margin - away;
        if (!near_goal) repulsion[k] += std::max(inflation - away, 0.0f);
      }
    };
    return sweep(batch, costs, its, 1, options_.collision_cost, raw, repel);
  }

  void finish(std::span<float> raw) override {
    const float least = *std::min_element(repulsion_.begin(), repulsion_.end());
    for (std::size_t k = 0; k < raw.size(); ++k) {
      raw[k] = static_cast<float>(options_.critical_weight) * raw[k] + share_ * (repulsion_[k] - least);
    }
  }

 private:
  Options options_;
  std::array<float, 256> distance_{};  // of obstacles, by cost
  float share_ = 0;                    // of the repulsion by a pose
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
