#include "mrpbench_mapf/single_agent/obstacles.hpp"

#include <algorithm>

namespace mrpbench::mapf {

void unite(std::vector<Range>& ranges) {
  if (ranges.size() < 2) return;
  std::ranges::sort(ranges, {}, &Range::first);
  std::size_t last = 0;
  for (const Range& range : ranges) {
    if (range.first <= ranges[last].last + 1) {
      ranges[last].last = std::max(ranges[last].last, range.last);
    } else {
      ranges[++last] = range;
    }
  }
  ranges.resize(last + 1);
}

}  // namespace mrpbench::mapf
