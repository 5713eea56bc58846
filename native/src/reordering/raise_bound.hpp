// A lower bound on how much later robots arrive because of decisions that are still pending.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

struct Raise {
  std::int32_t robot;
  Tick ticks;
};

/// The robots that arrive later with either choice, and by how much at least; sorted by robot.
using Raises = std::array<std::vector<Raise>, 2>;

/// Least sum of x[r] >= 0 over the robots such that each decision has a choice all of whose raises are at most x.
///
/// With one robot on each side, this is a vertex cover; decisions of separate robots add up. Found by branch and bound
/// for each connected part. Where a part takes long, a bound of decisions that share no robot stands for it.
Cost least_raise(int robots, std::span<const Raises> decisions, Limits& limits);

}  // namespace mrpbench::mapf
