// Paths that avoid one another where the detours are short, conflicts allowed.
#pragma once

#include "lns/schedule.hpp"

namespace mrpbench::mapf::lns {

/// Plan all robots in `schedule`, which holds paths with conflicts from then on.
void spread(Schedule& schedule);

}  // namespace mrpbench::mapf::lns
