#include "mrpbench_mapf/cbs/timed_path.hpp"

namespace mrpbench::mapf {

Path occupations(const Space& space, int robot, const TimedPath& path) {
  if (!space.textbook()) return {path.occupied.begin(), path.occupied.end()};
  Path result{at_vertex(path.at[0], 0, 0)};
  for (Tick tick = 1; tick <= path.last_tick(); ++tick) {
    const int tail = path.at[tick - 1], head = path.at[tick];
    if (tail != head) {
      result.push_back(on_edge(space.vertex_count() + space.edge(robot, tail, head), tick - 1, tick));
      result.push_back(at_vertex(head, tick, tick));
    }
    result.back().end = 2 * tick;
  }
  if (path.stays) result.back().end = kForeverHalf;
  return result;
}

}  // namespace mrpbench::mapf
