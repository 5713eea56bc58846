#include <set>

#include "algorithms/returns.hpp"
#include "check.hpp"
#include "mrpbench_mapf/algorithms/pibt.hpp"
#include "plans.hpp"

using namespace mrpbench::mapf;

namespace {

constexpr Tick kLong = 1000;

/// Vertices that are visited again.
std::size_t returns(const Path& path) {
  std::set<int> visited;
  for (std::size_t step = 0; step < path.size(); step += 2) visited.insert(path[step].element);
  return (path.size() + 1) / 2 - visited.size();
}

/// One vertex per tick.
Path walk(const Roadmap& road, const std::vector<int>& vertices) {
  Path path{at_vertex(vertices[0], 0, 0)};
  for (Tick tick = 0; tick + 1 < static_cast<Tick>(vertices.size()); ++tick) {
    const int tail = vertices[tick], head = vertices[tick + 1];
    if (tail == head) continue;
    path.back().end = 2 * tick;
    path.push_back(on_edge(road.vertex_count() + edge_between(road, tail, head), tick, tick + 1));
    path.push_back(at_vertex(head, tick + 1, tick + 1));
  }
  path.back().end = kForeverHalf;
  return path;
}

std::vector<Path> without_returns(const Instance& it, std::vector<Path> paths) {
  Limits limits = unlimited();
  leave_out_returns(it, Relations(it, limits), paths, limits);
  return paths;
}

}  // namespace

TEST("a robot that is alone waits wherever it would return to") {
  const Instance alone = instance(grid(3, 3), {robot(0, 8)}, {.horizon = kLong});
  const std::vector<Path> paths = without_returns(alone, {walk(alone.roadmap(), {0, 1, 4, 3, 0, 1, 2, 5, 8, 5, 8})});
  CHECK(returns(paths[0]) == 0);
  CHECK(paths[0].size() == 2 * 4 + 1 && paths[0].back().begin == 2 * 8);
}

TEST("a robot gives way as before where another one needs its place, and after the horizon") {
  const Roadmap road = grid(3, 2);
  const std::vector<Path> crossing{walk(road, {1, 4, 4, 4, 1}), walk(road, {0, 0, 1, 2})};
  const Instance two = instance(road, {robot(1, 1), robot(0, 2)}, {.horizon = kLong});
  CHECK(without_returns(two, crossing)[0].size() == crossing[0].size());
  const std::vector<Path> free{walk(road, {1, 4, 1, 4, 1}), walk(road, {0, 0, 0, 0})};
  const auto moves_within = [&](Tick horizon) {
    const Instance it = instance(road, {robot(1, 1), robot(0, 0)}, {.horizon = horizon});
    return without_returns(it, free)[0].size() / 2;
  };
  CHECK(moves_within(1) == 4 && moves_within(2) == 2 && moves_within(3) == 2 && moves_within(4) == 0);
}

TEST("plans stay without conflicts, and end where they did, not later") {
  Random random(4);
  std::size_t before = 0, after = 0;
  for (int k = 0; k < 300; ++k) {
    const Instance whole = random_instance(random, 5, 4, 2 + random.below(9));
    Limits limits = unlimited();
    Result result = solve_pibt(whole, {.steps = 500, .seed = 1}, limits);
    if (result.status != Status::solved) continue;
    const Instance windowed = instance(whole.roadmap(), whole.robots(), {.horizon = kLong});
    const std::vector<Path> old = result.paths;
    result.paths = without_returns(windowed, old);
    CHECK(faults(whole, result) == 0);
    for (std::size_t robot = 0; robot < old.size(); ++robot) {
      CHECK(arrival(result.paths[robot]) <= arrival(old[robot]));
      before += old[robot].size(), after += result.paths[robot].size();
    }
  }
  CHECK(after < before);
}
