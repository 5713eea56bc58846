// A path for each robot that it follows where it can. Paths that avoid one another spread the robots over the roadmap:
// the space utilisation of Okumura, "Engineering LaCAM*: Towards real-time, large-scale, and near-optimal multi-agent
// pathfinding", AAMAS 2024.
#pragma once

#include "mrpbench_mapf/model/result.hpp"

namespace mrpbench::mapf::lacam {

class GuidePaths {
 public:
  /// By robot; paths that are in conflict will do.
  explicit GuidePaths(std::span<const Path> paths);

  /// Where `robot` should go from `vertex`, -1 if its path does not lead there.
  std::int32_t next(int robot, std::int32_t vertex) const;
  /// When the last robot would arrive.
  Tick longest() const { return longest_; }

 private:
  struct Step {
    std::int32_t from, to;
  };
  std::vector<std::vector<Step>> steps_;  // by robot, sorted by `from`
  Tick longest_ = 0;
};

}  // namespace mrpbench::mapf::lacam
