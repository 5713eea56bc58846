// How a conflict is best resolved: by what branches, and how much they raise the cost.
#pragma once

#include "mrpbench_mapf/cbs/conflict.hpp"
#include "mrpbench_mapf/cbs/workbench.hpp"

namespace mrpbench::mapf {

class Reasoning {
 public:
  explicit Reasoning(Workbench& bench) : bench_(bench) {}

  /// Fill in what `conflict` says about its resolution, unless that was done before.
  void examine(const Situation& situation, Conflict& conflict);

 private:
  Workbench& bench_;
};

}  // namespace mrpbench::mapf
