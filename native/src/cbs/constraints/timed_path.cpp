#include "mrpbench_mapf/cbs/constraints/timed_path.hpp"

namespace mrpbench::mapf {

void follow(const Space& space, int robot, std::span<const Stop> stops, FoundPath& path) {
  const Beginning& beginning = space.instance().beginning(robot);
  path.at.clear();
  path.occupied.assign(beginning.occupied.begin(), beginning.occupied.end());
  path.cost = stops.size() == 1 ? enter_tick(beginning.occupied.back()) : stops.back().tick;
  if (space.classical()) {
    for (const Occupation& it : beginning.occupied) {
      if (it.element < space.vertex_count()) path.at.resize(it.end / 2 + 1, it.element);
    }
    for (const Stop& it : stops.subspan(1)) path.at.push_back(it.vertex);
    path.occupied.clear();
    return;
  }
  for (std::size_t k = 1; k < stops.size(); ++k) {
    path.occupied.back().end = 2 * stops[k - 1].tick;
    if (stops[k].edge < 0) continue;
    path.occupied.push_back(on_edge(space.vertex_count() + stops[k].edge, stops[k - 1].tick, stops[k].tick));
    path.occupied.push_back(at_vertex(stops[k].vertex, stops[k].tick, stops[k].tick));
  }
  if (!space.instance().rules().disappear_at_goal) path.occupied.back().end = kForeverHalf;
}

Path occupations(const Space& space, int robot, const TimedPath& path) {
  if (!space.classical()) return {path.occupied.begin(), path.occupied.end()};
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
