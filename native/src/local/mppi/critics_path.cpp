// Critics that compare samples with the local plan and its end.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mrpbench_common/wide.hpp"
#include "mrpbench_local/mppi/critic.hpp"

namespace mrpbench::local::mppi {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float wrapped(float angle) {
  return angle - 2 * kPi * std::floor((angle + kPi) / (2 * kPi));
}

/// Add a share of the distance from a place.
MRPBENCH_WIDE void add_distance(const float* x, const float* y, float px, float py, float share, std::span<float> raw) {
  MRPBENCH_NO_OVERLAP
  for (std::size_t k = 0; k < raw.size(); ++k) {
    const float dx = x[k] - px, dy = y[k] - py;
    raw[k] += std::sqrt(dx * dx + dy * dy) * share;
  }
}

/// Mean distance from the end of the plan.
class Goal : public Critic {
 public:
  struct Options : Weighting {
    double threshold_to_consider = 1.4;
    static Description<Options> description() {
      return {{"threshold_to_consider", &Options::threshold_to_consider, at_least(0, "m"),
               "act when no more of the path is left"}};
    }
  };
  explicit Goal(const Options& options) : options_(options) {}

  bool score(const Batch& batch, std::span<float> raw) override {
    if (batch.path.length > static_cast<float>(options_.threshold_to_consider)) return true;
    const float gx = batch.path.x.back(), gy = batch.path.y.back();
    const float share = 1.0f / static_cast<float>(batch.steps());
    for (std::size_t t = 0; t < batch.steps(); ++t) add_distance(batch.x[t], batch.y[t], gx, gy, share, raw);
    return true;
  }

 private:
  Options options_;
};

/// Mean difference from the yaw at the end of the path, if one is prescribed.
class GoalAngle : public Critic {
 public:
  struct Options : Weighting {
    double threshold_to_consider = 0.5;
    bool symmetric_yaw_tolerance = false;
    static Description<Options> description() {
      return {{"threshold_to_consider", &Options::threshold_to_consider, at_least(0, "m"),
               "act when no more of the path is left"},
              {"symmetric_yaw_tolerance", &Options::symmetric_yaw_tolerance, "the opposite yaw is as good"}};
    }
  };
  explicit GoalAngle(const Options& options) : options_(options) {}

  bool score(const Batch& batch, std::span<float> raw) override {
    if (!batch.goal_yaw || batch.path.length > static_cast<float>(options_.threshold_to_consider)) return true;
    add(batch, *batch.goal_yaw, options_.symmetric_yaw_tolerance, raw);
    return true;
  }

 private:
  MRPBENCH_WIDE static void add(const Batch& batch, float goal, bool symmetric, std::span<float> raw) {
    const float share = 1.0f / static_cast<float>(batch.steps());
    for (std::size_t t = 0; t < batch.steps(); ++t) {
      const float* const yaw = batch.yaw[t];
      MRPBENCH_NO_OVERLAP
      for (std::size_t k = 0; k < raw.size(); ++k) {
        const float off = std::abs(wrapped(yaw[k] - goal));
        raw[k] += (symmetric ? std::min(off, kPi - off) : off) * share;
      }
    }
  }

  Options options_;
};

/// Mean distance from the points of the plan at the same length.
class PathAlign : public Critic {
 public:
  struct Options : Weighting {
    double threshold_to_consider = 0.5, max_path_occupancy_ratio = 0.07;
    int offset_from_furthest = 20, trajectory_point_step = 4;
    static Description<Options> description() {
      return {{"threshold_to_consider", &Options::threshold_to_consider, at_least(0, "m"),
               "act while more of the path is left"},
              {"max_path_occupancy_ratio", &Options::max_path_occupancy_ratio, within(0, 1),
               "leave the path to the others where more of it is occupied"},
              {"offset_from_furthest", &Options::offset_from_furthest, at_least(0),
               "act when samples come farther than so many points"},
              {"trajectory_point_step", &Options::trajectory_point_step, at_least(1), "look at every so many poses"}};
    }
  };
  explicit PathAlign(const Options& options) : options_(options) {}

  bool looks_at_furthest() const override { return true; }

  bool score(const Batch& batch, std::span<float> raw) override {
    const LocalPath& path = batch.path;
    if (path.length < static_cast<float>(options_.threshold_to_consider)) return true;
    if (batch.furthest < static_cast<std::size_t>(options_.offset_from_furthest)) return true;
    const auto most = static_cast<std::int32_t>(batch.furthest) - 1;
    const auto taken = std::count(path.free.begin(), path.free.begin() + most + 1, 0);
    const double ratio = static_cast<double>(taken) / (most + 1);
    if (taken > 2 && ratio > options_.max_path_occupancy_ratio) return true;
    add(batch, most, taken == 0, raw);
    return true;
  }

 private:
  /// `most`: the last point of the plan that poses are compared with. `all`: all points up to it are free.
  MRPBENCH_WIDE void add(const Batch& batch, std::int32_t most, bool all, std::span<float> raw) {
    const LocalPath& path = batch.path;
    const std::size_t count = raw.size(), step = static_cast<std::size_t>(options_.trajectory_point_step);
    along_.assign(count, 0);
    number_.assign(count, 0);
    counts_.assign(path.free.begin(), path.free.end());
    float *const along = along_.data(), *const number = number_.data(), *const sums = raw.data();
    const float *const path_x = path.x.data(), *const path_y = path.y.data(), *const counts = counts_.data();
    const float per = 1 / path.spacing;
    for (std::size_t t = step; t < batch.steps(); t += step) {
      const float *x = batch.x[t], *y = batch.y[t], *bx = batch.x[t - step], *by = batch.y[t - step];
      const auto each = [=](auto&& count_of) {
        MRPBENCH_NO_OVERLAP
        for (std::size_t k = 0; k < count; ++k) {
          const float sx = x[k] - bx[k], sy = y[k] - by[k];
          along[k] += std::sqrt(sx * sx + sy * sy);
          const std::int32_t at = std::min(static_cast<std::int32_t>(along[k] * per + 0.5f), most);
          const float dx = x[k] - path_x[at], dy = y[k] - path_y[at], counting = count_of(at);
          sums[k] += std::sqrt(dx * dx + dy * dy) * counting;
          number[k] += counting;
        }
      };
      if (all) {
        each([](std::int32_t) { return 1.0f; });
      } else {
        each([=](std::int32_t at) { return counts[at]; });
      }
    }
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < count; ++k) sums[k] /= std::max(number[k], 1.0f);
  }

  Options options_;
  std::vector<float> along_, number_, counts_;  // counts_: 1 for free points of the plan, 0 for others
};

/// Distance of the last pose from a point of the plan ahead of where samples come.
class PathFollow : public Critic {
 public:
  struct Options : Weighting {
    double threshold_to_consider = 1.4;
    int offset_from_furthest = 6;
    static Description<Options> description() {
      return {{"threshold_to_consider", &Options::threshold_to_consider, at_least(0, "m"),
               "act while more of the path is left"},
              {"offset_from_furthest", &Options::offset_from_furthest, at_least(0),
               "points from where samples come to the one that is aimed at"}};
    }
  };
  explicit PathFollow(const Options& options) : options_(options) {}

  bool looks_at_furthest() const override { return true; }

  bool score(const Batch& batch, std::span<float> raw) override {
    const LocalPath& path = batch.path;
    if (path.length < static_cast<float>(options_.threshold_to_consider)) return true;
    std::size_t at = batch.beyond_furthest(options_.offset_from_furthest);
    while (at + 1 < path.size() && !path.free[at]) ++at;
    const std::size_t last = batch.steps() - 1;
    add_distance(batch.x[last], batch.y[last], path.x[at], path.y[at], 1, raw);
    return true;
  }

 private:
  Options options_;
};

/// Angle between the last heading and the direction to a point of the plan ahead.
class PathAngle : public Critic {
 public:
  struct Options : Weighting {
    double threshold_to_consider = 0.5, max_angle_to_furthest = 0.785;
    int offset_from_furthest = 4, mode = 0;
    static Description<Options> description() {
      return {{"threshold_to_consider", &Options::threshold_to_consider, at_least(0, "m"),
               "act while more of the path is left"},
              {"max_angle_to_furthest", &Options::max_angle_to_furthest, at_least(0),
               "act when that point is farther off the robot's heading, radians"},
              {"offset_from_furthest", &Options::offset_from_furthest, at_least(0),
               "points from where samples come to the one that is looked at"},
              {"mode", &Options::mode, within(0, 2),
               "0: prefer driving forward; 1: back is as good; 2: prefer the direction of the path"}};
    }
  };
  explicit PathAngle(const Options& options) : options_(options) {}

  bool looks_at_furthest() const override { return true; }

  bool score(const Batch& batch, std::span<float> raw) override {
    const LocalPath& path = batch.path;
    if (path.length < static_cast<float>(options_.threshold_to_consider)) return true;
    const std::size_t at = batch.beyond_furthest(options_.offset_from_furthest);
    const float px = path.x[at], py = path.y[at], along = path.yaw[at];
    const float now = off(std::atan2(py, px), 0, along);
    if (now < static_cast<float>(options_.max_angle_to_furthest)) return true;
    const std::size_t last = batch.steps() - 1;
    const float *x = batch.x[last], *y = batch.y[last], *yaw = batch.end_yaw.data();
    for (std::size_t k = 0; k < raw.size(); ++k) raw[k] = off(std::atan2(py - y[k], px - x[k]), yaw[k], along);
    return true;
  }

 private:
  float off(float bearing, float yaw, float along) const {
    const float ahead = std::abs(wrapped(bearing - yaw));
    if (options_.mode == 0) return ahead;
    if (options_.mode == 1) return std::min(ahead, kPi - ahead);
    const float back = std::abs(wrapped(bearing - along)) > kPi / 2 ? kPi : 0.0f;
    return std::abs(wrapped(bearing + back - yaw));
  }

  Options options_;
};

}  // namespace

CriticKind goal_critic() {
  return kind_of<Goal>(5);
}

CriticKind goal_angle_critic() {
  return kind_of<GoalAngle>(3);
}

CriticKind path_align_critic() {
  return kind_of<PathAlign>(10);
}

CriticKind path_follow_critic() {
  return kind_of<PathFollow>(5);
}

CriticKind path_angle_critic() {
  return kind_of<PathAngle>(2.2);
}

}  // namespace mrpbench::local::mppi
