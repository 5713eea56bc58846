// The trajectories that MPPI samples in one period, and what its critics know.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "mrpbench_local/controller.hpp"
#include "mrpbench_local/costmap/costmap.hpp"
#include "mrpbench_local/forecast.hpp"

namespace mrpbench::local::mppi {

/// Samples are rolled out and scored by so many together, so that their numbers stay in the cache meanwhile.
constexpr std::size_t kBlock = 256;

/// Numbers of the samples of a block, in rows of a step each: vectors run over the samples. Each row begins with a line
/// of the cache, as a vector across two lines takes twice as long, and ends with numbers that no sample has, so that
/// vectors need no end of their own.
template <class T>
struct Rows {
  std::size_t steps = 0, samples = 0;

  void resize(std::size_t rows, std::size_t columns) {
    if (rows == steps && columns == samples) return;
    steps = rows;
    samples = columns;
    groups_.resize(rows * (width() / kGroup));
  }
  /// The numbers of a row.
  std::size_t width() const { return (samples + kGroup - 1) / kGroup * kGroup; }
  T* operator[](std::size_t t) { return groups_[t * (width() / kGroup)].values; }
  const T* operator[](std::size_t t) const { return groups_[t * (width() / kGroup)].values; }

 private:
  static constexpr std::size_t kGroup = 32;
  struct alignas(kGroup * sizeof(T)) Group {
    T values[kGroup];
  };
  std::vector<Group> groups_;
};
using Table = Rows<float>;

/// Velocities of a block of samples, within the limits of acceleration, and yaws.
struct Motions {
  Table vx, wz, yaw;
};

/// Places of a block of samples, the length of each in metres, and the yaw at its end.
struct Ways {
  Table x, y;
  std::vector<float> length, end_yaw;
};

struct Tables : Motions, Ways {
  void resize(std::size_t steps, std::size_t samples) {
    for (Table* it : {&vx, &wz, &x, &y, &yaw}) it->resize(steps, samples);
    for (auto* it : {&length, &end_yaw}) it->resize(vx.width());
  }
};

struct Batch;

/// Makes a batch that of a block, for a while. Threads have ways of all blocks, which stay until another robot is
/// controlled, but only one block of motions, so that all that a robot needs stays in the cache.
class Lent {
 public:
  Lent(Batch& to, std::size_t block, std::size_t steps, std::size_t samples);
  ~Lent();
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;

 private:
  Batch& to_;
  Ways& ways_;
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

/// The input of critics: a block of samples, and what is the same for all blocks. Poses are in the frame of the robot
/// at the start of the period.
struct Batch : Tables {
  /// The number of the first sample.
  std::size_t first = 0;
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
  /// The farthest point of the path that is the nearest one to the end of a sample (of any block), among those that the
  /// sample can reach by its length. Only for critics that look at it.
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
  /// Compute `furthest` of this block alone.
  std::size_t find_furthest();

 private:
  std::vector<float> nearest_;
  std::vector<std::int32_t> index_;
};

/// Add twists f8[m,p,2] and poses f8[m,p,3] of every so many samples and steps.
void add_trajectories(const Batch& batch, std::size_t every, std::size_t step, Samples& to);

}  // namespace mrpbench::local::mppi
