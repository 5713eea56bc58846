// The operations of EPIBT: short sequences of actions.
#pragma once

#include <vector>

#include "mrpbench_discrete/grid.hpp"

namespace mrpbench::discrete {

using Operation = std::vector<Action>;

/// All operations of `depth` actions whose last action but for waits is a move, with no turn that takes another back,
/// no wait after a turn before a move, and half turns in one direction alone: 17, 48 and 136 for depths 3, 4 and 5.
/// Those that move early come last.
std::vector<Operation> operations(int depth);

}  // namespace mrpbench::discrete
