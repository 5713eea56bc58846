#include "algorithms/returns.hpp"

#include <algorithm>

#include "mrpbench_mapf/single_agent/reservations.hpp"

namespace mrpbench::mapf {

namespace {

/// The index of the first visit from `free` on, of the vertex of `path[back]`, after which the robot can stay there.
std::size_t first_visit(const Path& path, std::size_t back, std::size_t free, int robot,
                        const Reservations& reservations) {
  std::size_t found = back;
  for (std::size_t visit = back; visit >= free + 2;) {
    visit -= 2;
    if (path[visit].element != path[back].element) continue;
    if (reservations.count(robot, {path[back].element, path[visit].end, path[back].begin}) > 0) break;
    found = visit;
  }
  return found;
}

}  // namespace

void leave_out_returns(const Instance& instance, const Relations& relations, std::vector<Path>& paths, Limits& limits) {
  Reservations reservations(instance, relations, limits);
  for (int robot = 0; robot < instance.size(); ++robot) reservations.add(robot, paths[robot]);
  const Half horizon = 2 * instance.rules().horizon;
  for (int robot = 0; robot < instance.size(); ++robot) {
    Path &path = paths[robot], kept;
    const std::size_t free = instance.beginning(robot).occupied.size() - 1;  // where commitments end
    for (std::size_t step = path.size(); step > 0; --step) {
      kept.push_back(path[step - 1]);
      if (step % 2 == 0 || kept.back().begin > horizon) continue;
      const std::size_t first = first_visit(path, step - 1, free, robot, reservations);
      if (first == step - 1) continue;
      kept.back().begin = path[first].begin;
      reservations.add(robot, {&kept.back(), 1});
      step = first + 1;
    }
    std::ranges::reverse(kept);
    path = std::move(kept);
  }
}

}  // namespace mrpbench::mapf
