// The distance from the end of a trajectory to the path, or to the end of its part within the costmap, counted in cells
// along rows and columns. The two alignment critics measure it at a point ahead of the robot.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mrpbench_common/wide.hpp"
#include "mrpbench_local/dwb/critics.hpp"

namespace mrpbench::local {

namespace {

constexpr Reason kOffGrid = "Trajectory Goes Off Grid.";
constexpr Reason kUnreachable = "Unreachable";
/// Nav2 scales these critics by half the resolution.
constexpr double kHalf = 0.5;

struct DistanceOptions {
  Aggregation aggregation = Aggregation::last;

  static Description<DistanceOptions> description() {
    return {{"aggregation_type", &DistanceOptions::aggregation,
             Choices<Aggregation>{
                 {"last", Aggregation::last}, {"sum", Aggregation::sum}, {"product", Aggregation::product}},
             "combination of the scores of poses into the score of the trajectory"}};
  }
};

struct AlignOptions {
  double forward_point_distance = 0.325;
  DistanceOptions distance;

  static Description<AlignOptions> description() {
    Description<AlignOptions> rows{{"forward_point_distance", &AlignOptions::forward_point_distance, at_least(0, "m"),
                                    "distance of the point that is scored ahead of the robot"}};
    append(rows, DistanceOptions::description(), &AlignOptions::distance);
    return rows;
  }
};

MRPBENCH_WIDE void look_up(std::size_t count, const int* x, const int* y, int width, const std::int16_t* distances,
                           double* raw) {
  for (std::size_t i = 0; i < count; ++i) raw[i] = distances[y[i] * width + x[i]];
}

/// Steps along rows and columns to a cell.
MRPBENCH_WIDE void add_sides(std::size_t count, const int* x, const int* y, Cell to, double* raw) {
  for (std::size_t i = 0; i < count; ++i) raw[i] = std::abs(x[i] - to.x) + std::abs(y[i] - to.y);
}

/// Distances to the whole path, or to its end.
template <bool to_path>
class Distance : public Critic {
 public:
  using Options = DistanceOptions;
  explicit Distance(const Options& options, double nose = 0) : nose_(nose), aggregation_(options.aggregation) {}

  void prepare(const Scene& scene) override {
    if (scene.path->empty()) return;
    const Frame& frame = scene.costmap->frame();
    goal_ = frame.cell(scene.path->goal());
    const Point away{scene.goal.x - scene.pose.x, scene.goal.y - scene.pose.y};
    near_goal_ = nose_ > 0 && sim::length(away) <= nose_;
    if (to_path || nose_ == 0) return;
    // The end is shifted towards the goal, as the poses are.
    const double yaw = std::atan2(away.y, away.x);
    const Cell shifted = frame.cell(scene.path->goal() + Point{std::cos(yaw), std::sin(yaw)} * nose_);
    goal_ = frame.holds(shifted) ? shifted : scene.path->before_end();
  }

  double looks_ahead() const override { return nose_; }

  double weight(const Scene& scene) const override {
    if (to_path && near_goal_) return 0;  // near the goal the point ahead of the robot is beyond it
    return scene.costmap->frame().resolution * kHalf;
  }

  bool score(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason> why) override {
    const Frame& frame = scene.costmap->frame();
    if (scene.path->empty()) return fail(raw, why, frame);
    bool inside = false;
    if (aggregation_ == Aggregation::last) {
      const EndCells::Cells& ends = scene.ends->ahead(nose_);
      inside = ends.inside;
      if (inside && (!to_path || (scene.path->knows(ends.low) && scene.path->knows(ends.high)))) {
        count_cells(scene, ends, raw);
      } else {
        for (std::size_t i = 0; i < all.size(); ++i) {
          const Cell c{ends.x[i], ends.y[i]};
          raw[i] = frame.holds(c) ? cells(scene, c) : -1;
        }
      }
    } else {
      for (std::size_t i = 0; i < all.size(); ++i) {
        raw[i] = aggregate(aggregation_, all, i, [&](Pose pose) {
          const Cell c = nose_cell(frame, pose);
          return frame.holds(c) ? cells(scene, c) : -1;
        });
      }
    }
    if (inside) return false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (raw[i] < 0) why[i] = kOffGrid;
    }
    return true;
  }

  Reason check(const Scene& scene, Pose pose) override {
    if (nose_ > 0) return kLegal;  // only the end matters
    const Frame& frame = scene.costmap->frame();
    return frame.holds(frame.cell({pose.x, pose.y})) ? kLegal : kOffGrid;
  }

 private:
  Cell nose_cell(const Frame& frame, Pose pose) const {
    return frame.cell({pose.x + nose_ * std::cos(pose.yaw), pose.y + nose_ * std::sin(pose.yaw)});
  }

  /// Of a cell of the frame.
  double cells(const Scene& scene, Cell c) const {
    if constexpr (to_path) return scene.path->distance(scene.costmap->frame(), c);
    return std::abs(c.x - goal_.x) + std::abs(c.y - goal_.y);
  }

  /// Of the cells of all ends, whose distances are known.
  void count_cells(const Scene& scene, const EndCells::Cells& ends, std::span<double> raw) const {
    if constexpr (to_path) {
      look_up(raw.size(), ends.x.data(), ends.y.data(), scene.costmap->frame().width, scene.path->distances().data(),
              raw.data());
    } else {
      add_sides(raw.size(), ends.x.data(), ends.y.data(), goal_, raw.data());
    }
  }

  /// If no part of the path is on the map, all cells have the same distance.
  bool fail(std::span<double> raw, std::span<Reason> why, const Frame& frame) const {
    std::ranges::fill(raw, static_cast<double>(frame.size() + 1));
    if (nose_ == 0) std::ranges::fill(why, kUnreachable);
    return nose_ == 0;
  }

  double nose_;
  Aggregation aggregation_;
  Cell goal_;
  bool near_goal_ = false;
};

template <bool to_path>
class Alignment : public Distance<to_path> {
 public:
  using Options = AlignOptions;
  explicit Alignment(const Options& options) : Distance<to_path>(options.distance, options.forward_point_distance) {}
};

}  // namespace

CriticKind path_dist() {
  return kind_of<Distance<true>>();
}

CriticKind goal_dist() {
  return kind_of<Distance<false>>();
}

CriticKind path_align() {
  return kind_of<Alignment<true>>();
}

CriticKind goal_align() {
  return kind_of<Alignment<false>>();
}

}  // namespace mrpbench::local
