// A problem of the League of Robot Runners; what its fields mean is in plugins/league/mrpbench_league/files/problem.py.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mrpbench_discrete/grid.hpp"

namespace mrpbench::discrete {

struct Delays {
  int least = 0, most = 0;
  bool poisson = false, gaussian = false;
  double probability = 0, mean_ratio = 0.5, deviation_ratio = 0.22;
  std::uint64_t seed = 0;
};

struct Problem {
  int season;
  Grid grid;
  /// Free cells.
  std::vector<std::int32_t> start, errands;
  std::vector<std::int32_t> first;
  /// 2023: goals per robot; later: visible tasks.
  int visible = 1;
  std::string strategy = "roundrobin";
  int counter = 1;
  double size = 1;
  Delays delays;

  std::size_t robots() const { return start.size(); }
  int lines() const { return static_cast<int>(first.size()) - 1; }
};

}  // namespace mrpbench::discrete
