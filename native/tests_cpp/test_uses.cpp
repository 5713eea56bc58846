#include <algorithm>

#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/model/uses.hpp"

using namespace mrpbench::mapf;

namespace {

/// Robots on a line of five vertices, of which 1 and 2 and the edges between belong to one resource and 4 to another.
Instance line(int robots, int capacity, Tick setup) {
  Roadmap road = grid(5, 1);
  const int there = 5 + edge_between(road, 1, 2), back = 5 + edge_between(road, 2, 1);
  std::vector<Robot> all(robots, robot(0, 0));
  return Instance(std::move(road), std::move(all), {}, {}, {{capacity, setup, {1, 2, there, back}}, {1, 0, {4}}});
}

Path along(const Roadmap& road, Tick start) {
  Path path{at_vertex(0, 0, start)};
  for (int vertex = 0; vertex < 4; ++vertex, ++start) {
    path.push_back(on_edge(5 + edge_between(road, vertex, vertex + 1), start, start + 1));
    path.push_back(at_vertex(vertex + 1, start + 1, start + 1));
  }
  path.back().end = kForeverHalf;
  return path;
}

bool same(const Use& use, int resource, Half first, Half last) {
  return use.resource == resource && use.halves == Range{first, last};
}

}  // namespace

TEST("a use lasts from the first element to the setup after the last one") {
  const Instance it = line(1, 1, 3);
  const std::vector<Use> found = uses(it, along(it.roadmap(), 10));
  CHECK(found.size() == 2);
  CHECK(same(found[0], 0, 22, 24 + 6));        // at 1 from tick 11, at 2 until tick 12
  CHECK(same(found[1], 1, 28, kForeverHalf));  // stays at 4 from tick 14
}

TEST("a robot that comes back within the setup has not stopped using it") {
  const Roadmap road = grid(5, 1);
  const auto edge = [&](int tail, int head) { return 5 + edge_between(road, tail, head); };
  const Path path{at_vertex(1, 0, 0), on_edge(edge(1, 0), 0, 1), at_vertex(0, 1, 1), on_edge(edge(0, 1), 1, 2),
                  at_vertex(1, 2, 2)};
  CHECK(uses(line(1, 1, 2), path).size() == 1);
  CHECK(uses(line(1, 1, 1), path).size() == 2);
}

TEST("conflicts are pairs of users beyond the capacity only") {
  const Instance one = line(3, 1, 0), two = line(3, 2, 0);
  const Path first = along(one.roadmap(), 0), second = along(one.roadmap(), 1), last = along(one.roadmap(), 9);
  const std::vector<std::span<const Occupation>> close{first, second, {}}, apart{first, {}, last};
  const auto in_passage = [](const std::vector<CapacityConflict>& found) {
    return std::ranges::count_if(found, [](const CapacityConflict& it) { return it.time < 8; });  // later all are at 4
  };
  const std::vector<CapacityConflict> found = find_capacity_conflicts(one, close);
  CHECK(in_passage(found) == 1);
  CHECK(found[0].one == 0 && found[0].other == 1 && found[0].time == 4);
  CHECK(in_passage(find_capacity_conflicts(two, close)) == 0);
  CHECK(in_passage(find_capacity_conflicts(one, apart)) == 0);
}
