// The trajectories that MPPI samples in one period, and what its critics know.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "mrpbench_local/costmap/costmap.hpp"
#include "mrpbench_local/forecast.hpp"

namespace mrpbench::local::mppi {

/// One number per sample, in rows of a step each: vectors run over the samples. Each row begins with a line of the
/// cache, as a vector across two lines takes twice as long.
struct Table {
  std::size_t steps = 0, samples = 0;

  void resize(std::size_t rows, std::size_t columns) {
    if (rows == steps && columns == samples) return;
    steps = rows;
    samples = columns;
    width_ = (columns + kLine - 1) / kLine;
    lines_.assign(rows * width_, {});
  }
  float* operator[](std::size_t t) { return lines_[t * width_].values; }
  const float* operator[](std::size_t t) const { return lines_[t * width_].values; }

 private:
  static constexpr std::size_t kLine = 16;
  struct alignas(kLine * sizeof(float)) Line {
    float values[kLine];
  };
  std::size_t width_ = 0;  // lines of a row
  std::vector<Line> lines_;
};

/// The samples: velocities within the limits of acceleration, poses, and the length of each in metres.
struct Tables {
  Table vx, wz, x, y, yaw;
  std::vector<float> length;

  void resize(std::size_t steps, std::size_t samples) {
    for (Table* it : {&vx, &wz, &x, &y, &yaw}) it->resize(steps, samples);
    length.resize(samples);
  }
};

/// Lends the tables of a thread for a while, so that the robots that it controls share them and they stay in its cache.
class Lent {
 public:
  Lent(Tables& to, std::size_t steps, std::size_t samples);
  ~Lent();
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;

 private:
  Tables& to_;
};

/// The highest speeds now, and the shape of turns.
struct Limits {
  float vx_max = 0.5f, vx_min = -0.35f, wz_max = 1.9f;
  /// Of Ackermann steering; 0 = the robot turns on the spot.
  float min_turning_r = 0;
};

/// The local plan in the frame of the robot: points of equal spacing, only the last step may be shorter.
struct LocalPath {
  std::vector<float> x, y, yaw;
  std::vector<char> free;
  float spacing = 0.05f;
  float length = 0;

  std::size_t size() const { return x.size(); }
};

/// The input of critics. Poses are in the frame of the robot at the start of the period.
struct Batch : Tables {
  float dt = 0.05f;
  Limits limits;
  LocalPath path;
  /// Yaw at the end of the path; nothing = any.
  std::optional<float> goal_yaw;
  float tolerance = 0.1f;
  const Costmap* costmap = nullptr;
  const Forecast* forecast = nullptr;
  Pose robot;
  /// Unit vector along the robot's heading.
  Point heading{1, 0};
  bool by_radius = true;
  /// The farthest point of the path that is the nearest one to the end of a sample, among those that the sample can
  /// reach by its length.
  std::size_t furthest = 0;

  std::size_t steps() const { return vx.steps; }
  std::size_t samples() const { return vx.samples; }
  /// Set the pose of the robot.
  void place(Pose pose);
  /// A pose in the frame of the robot as one in the map.
  Pose in_map(float px, float py, float turned) const {
    return {robot.x + heading.x * px - heading.y * py, robot.y + heading.y * px + heading.x * py, robot.yaw + turned};
  }
  /// The index of the path point `offset` points beyond `furthest`, or of the last one.
  std::size_t beyond_furthest(int offset) const {
    return std::min(furthest + static_cast<std::size_t>(offset), path.size() - 1);
  }
  /// Compute `furthest`.
  void find_furthest();

 private:
  std::vector<float> nearest_;
  std::vector<std::int32_t> index_;
};

}  // namespace mrpbench::local::mppi
