// The search of a constraint tree, the same for all variants of conflict-based search.
#pragma once

#include <functional>

#include "mrpbench_mapf/cbs/tree/low_level.hpp"
#include "mrpbench_mapf/cbs/tree/open_list.hpp"

namespace mrpbench::mapf {

/// Search the tree that `open` and `low_level` make, and fill in `result`. Before it expands a node,
/// `solved_otherwise` may say that `result` has a solution already.
void search_tree(
    SearchContext& context, OpenList& open, LowLevel& low_level, Result& result,
    const std::function<bool()>& solved_otherwise = [] { return false; });

}  // namespace mrpbench::mapf
