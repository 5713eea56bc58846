// What can be switched off in conflict-based search, each with the paper it comes from.
#pragma once

#include <cstdint>

namespace mrpbench::mapf {

struct CbsOptions {
  /// Cardinal conflicts first: Boyarski et al., "ICBS: Improved conflict-based search algorithm for multi-agent
  /// pathfinding", IJCAI 2015.
  bool prioritize = true;
  /// Take over paths as cheap with fewer conflicts instead of branching: Boyarski et al., "Don't split, try to work it
  /// out: bypassing conflicts in multi-agent pathfinding", ICAPS 2015.
  bool bypass = true;
};

}  // namespace mrpbench::mapf
