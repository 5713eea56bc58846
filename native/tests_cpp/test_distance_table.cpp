#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

using namespace mrpbench::mapf;

namespace {

/// Distances by Bellman-Ford.
std::vector<Tick> distances(const Roadmap& roadmap, int profile, const std::vector<int>& goals) {
  std::vector<Tick> distance(roadmap.vertex_count(), kForever);
  for (const int goal : goals) distance[goal] = 0;
  for (int round = 0; round < roadmap.vertex_count(); ++round) {
    for (int edge = 0; edge < roadmap.edge_count(); ++edge) {
      const Tick ticks = roadmap.duration(profile)[edge];
      const Tick rest = distance[roadmap.head(edge)];
      if (ticks > 0 && rest != kForever)
        distance[roadmap.tail(edge)] = std::min(distance[roadmap.tail(edge)], ticks + rest);
    }
  }
  return distance;
}

Roadmap random_graph(unsigned seed, Tick longest) {
  const int vertices = 40, edges = 90;
  std::vector<int> tail, head;
  std::vector<Tick> duration;
  const auto random = [&](unsigned limit) { return (seed = seed * 1664525u + 1013904223u) / 65536u % limit; };
  for (int e = 0; e < edges; ++e) {
    tail.push_back(static_cast<int>(random(vertices)));
    head.push_back(static_cast<int>(random(vertices)));
  }
  for (int e = 0; e < 2 * edges; ++e) {
    duration.push_back(random(8) == 0 ? -1 : 1 + static_cast<Tick>(random(static_cast<unsigned>(longest))));
  }
  return Roadmap(vertices, tail, head, duration);
}

}  // namespace

TEST("distances are those of Bellman-Ford, in any order of queries, flat and in pages") {
  for (unsigned seed = 0; seed < 120; ++seed) {
    constexpr Tick kLongest[] = {1, 9, 1, 900};  // of the last, differences do not fit into a byte
    const Roadmap roadmap = random_graph(seed, kLongest[seed % 4]);
    const std::vector<int> goals{static_cast<int>(seed % 40), static_cast<int>(seed * 7 % 40)};
    const std::vector<Tick> expected = distances(roadmap, static_cast<int>(seed % 2), goals);
    Limits limits = unlimited();
    DistanceTable table(roadmap, static_cast<int>(seed % 2), goals, limits, nullptr, seed >= 60);
    for (int i = 0; i < 40; ++i) {
      const int vertex = (i * 17 + static_cast<int>(seed)) % 40;
      CHECK(table(vertex) == expected[vertex]);
    }
  }
}

TEST("pages hold a byte per vertex where all edges take equally long, and nothing where no search came") {
  const Roadmap roadmap = grid(100, 100);
  Limits flat_limits = unlimited(), near_limits = unlimited(), far_limits = unlimited();
  const std::vector<int> goals{0};
  DistanceTable flat(roadmap, 0, goals, flat_limits), near(roadmap, 0, goals, near_limits, nullptr, true),
      far(roadmap, 0, goals, far_limits, nullptr, true);
  CHECK(near(5) == 5);
  for (int vertex = 0; vertex < 10000; ++vertex) CHECK(far(vertex) == flat(vertex));
  CHECK(near_limits.memory_used() < 2000);
  CHECK(5 * far_limits.memory_used() < 2 * flat_limits.memory_used());
}

TEST("robots with the same goals and profile share a table") {
  std::vector<Robot> robots{robot(0, 3), robot(1, 3), robot(2, 0)};
  robots[0].goals = {3, 2};
  robots[1].goals = {2, 3};
  const Instance three = instance(grid(2, 2), robots);
  Limits limits = unlimited();
  DistanceTables tables(three, limits);
  CHECK(&tables[0] == &tables[1]);
  CHECK(&tables[0] != &tables[2]);
}

TEST("of robots that visit goals in order, tables hold what is left of the way over them") {
  Robot it = robot(0, 0);
  it.via = {{3, 6}, {8}};
  Robot begun = robot(2, 0);
  begun.via = {{2}, {8}};
  const Instance two = instance(grid(3, 3), {it, begun});
  CHECK(two.beginning(0).visited == 0);
  CHECK(two.beginning(1).visited == 1);  // it starts at its first goal
  Limits limits = unlimited();
  DistanceTables tables(two, limits);
  CHECK(tables.remaining(0).size() == 3);
  CHECK(tables[0](0) == 8);  // 0 3 6 8 0, or 0 3 8 0: both take 8
  CHECK(tables[0](6) == 6);
  CHECK((*tables.remaining(0)[1])(6) == 6);
  CHECK((*tables.remaining(0)[2])(6) == 2);
  CHECK(&tables[1] == tables.remaining(0)[1]);
  CHECK(tables.least_cost(two, 1) == 6);
}

TEST("a cache gives tables of the call before to the next one, and forgets those that are not used") {
  const auto cache = std::make_shared<DistanceCache>(std::make_shared<const Roadmap>(grid(3, 3)));
  const auto to = [&](int goal) { return Instance(cache->roadmap(), {robot(0, goal)}, {}, {}, {}, cache); };
  const auto table_to = [&](int goal) {
    Limits limits = unlimited();
    const Instance one = to(goal);
    DistanceTables tables(one, limits);
    CHECK(tables[0](0) == distances(one.roadmap(), 0, {goal})[0]);
    CHECK(limits.memory_used() > 0);
    return &tables[0];
  };
  const DistanceTable* const first = table_to(8);
  CHECK(table_to(8) == first);
  CHECK(cache->take({0, {4}}) == nullptr);
  table_to(4);
  CHECK(cache->take({0, {8}}) == nullptr);
  CHECK(cache->take({0, {4}}) != nullptr);
}
