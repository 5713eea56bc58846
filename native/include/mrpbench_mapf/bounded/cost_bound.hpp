// How much the path of one robot may cost.
#pragma once

#include <algorithm>
#include <cmath>

#include "mrpbench_mapf/time.hpp"

namespace mrpbench::mapf {

/// At most floor(w * (least + others_least)) - others_cost, but always `least`, a lower bound on the cost of the path
/// itself. With others of zero that is w times its own bound; with what is known of all others it is what they leave.
struct CostBound {
  double w = 1.0;
  Cost others_least = 0, others_cost = 0;

  Tick operator()(Tick least) const {
    const auto total = static_cast<Cost>(std::floor(w * static_cast<double>(others_least + least)));
    return static_cast<Tick>(std::clamp<Cost>(total - others_cost, least, kForever - 1));
  }
};

}  // namespace mrpbench::mapf
