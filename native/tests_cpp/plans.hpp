// Checks of plans, and brute force over joint configurations, for the tests.
#pragma once

#include <map>

#include "grids.hpp"
#include "mrpbench_mapf/common/random.hpp"
#include "mrpbench_mapf/model/conflict.hpp"

namespace mrpbench::mapf {

/// Conflicts between all pairs of paths, and 1 for each path that does not lead from start to a goal.
inline int faults(const Instance& it, const Result& result) {
  Limits limits = unlimited();
  const Relations relations(it, limits);
  int number = static_cast<int>(result.paths.size()) != it.size();
  for (int one = 0; one < static_cast<int>(result.paths.size()); ++one) {
    const Path& path = result.paths[one];
    const Robot& robot = it.robots()[one];
    number += path.front().element != robot.start;
    number += std::find(robot.goals.begin(), robot.goals.end(), path.back().element) == robot.goals.end();
    for (std::size_t step = 0; step + 2 < path.size(); step += 2) {
      const int edge = path[step + 1].element - it.roadmap().vertex_count();
      number += edge < 0 || it.roadmap().tail(edge) != path[step].element ||
                it.roadmap().head(edge) != path[step + 2].element || path[step + 1].begin != path[step].end + 1 ||
                path[step + 2].begin != path[step + 1].end + 1;
    }
    for (int other = 0; other < one; ++other) {
      number += find_conflict(it, relations, one, path, other, result.paths[other]).count;
    }
  }
  return number;
}

/// Robots with distinct starts and distinct goals on a grid of which some cells are cut out.
inline Instance random_instance(Random& random, int width, int height, int robots) {
  while (true) {
    const Roadmap whole = grid(width, height);
    std::vector<int> index(whole.vertex_count(), -1);
    int cells = 0;
    for (int& cell : index) {
      if (random.below(5) > 0) cell = cells++;
    }
    if (cells < robots) continue;
    std::vector<int> tail, head;
    for (int edge = 0; edge < whole.edge_count(); ++edge) {
      if (index[whole.tail(edge)] < 0 || index[whole.head(edge)] < 0) continue;
      tail.push_back(index[whole.tail(edge)]);
      head.push_back(index[whole.head(edge)]);
    }
    std::vector<int> starts(cells), goals(cells);
    for (int cell = 0; cell < cells; ++cell) starts[cell] = goals[cell] = cell;
    random.shuffle(starts);
    random.shuffle(goals);
    std::vector<Robot> all;
    for (int k = 0; k < robots; ++k) all.push_back(robot(starts[k], goals[k]));
    std::vector<Tick> duration(tail.size(), 1);
    return instance(Roadmap(cells, tail, head, duration), all);
  }
}

/// The least makespan by breadth-first search over joint configurations, -1 if there is no plan.
inline Cost least_makespan(const Instance& it) {
  using Joint = std::vector<int>;
  Joint start, goal;
  for (const Robot& robot : it.robots()) {
    start.push_back(robot.start);
    goal.push_back(robot.goals.front());
  }
  std::map<Joint, Cost> seen{{start, 0}};
  std::vector<Joint> queue{start};
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const Joint at = queue[next];
    const Cost ticks = seen[at];
    if (at == goal) return ticks;
    Joint to = at;
    const auto assign = [&](const auto& self, std::size_t robot) -> void {
      if (robot == at.size()) {
        if (seen.try_emplace(to, ticks + 1).second) queue.push_back(to);
        return;
      }
      const auto try_vertex = [&](int vertex) {
        for (std::size_t other = 0; other < robot; ++other) {
          if (to[other] == vertex || (to[other] == at[robot] && at[other] == vertex)) return;
        }
        to[robot] = vertex;
        self(self, robot + 1);
      };
      try_vertex(at[robot]);
      for (const int edge : it.roadmap().out(at[robot])) try_vertex(it.roadmap().head(edge));
    };
    assign(assign, 0);
  }
  return -1;
}

}  // namespace mrpbench::mapf
