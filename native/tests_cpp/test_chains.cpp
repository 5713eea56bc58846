#include <numeric>

#include "check.hpp"
#include "mrpbench_mapf/infeasibility/chains.hpp"
#include "plans.hpp"

using namespace mrpbench::mapf;

namespace {

bool is_beyond_chain(const Instance& it) {
  Limits limits = unlimited();
  std::vector<int> vertices(it.roadmap().vertex_count()), robots(it.size());
  std::iota(vertices.begin(), vertices.end(), 0);
  std::iota(robots.begin(), robots.end(), 0);
  return find_robot_beyond_chain(it, vertices, robots, limits).has_value();
}

Instance two_way(int vertices, const std::vector<std::pair<int, int>>& ways, std::vector<Robot> robots) {
  std::vector<int> tail, head;
  for (const auto& [a, b] : ways) {
    tail.insert(tail.end(), {a, b});
    head.insert(head.end(), {b, a});
  }
  std::vector<Tick> duration(tail.size(), 1);
  return instance(Roadmap(vertices, tail, head, duration), std::move(robots));
}

/// A tree, mostly of long branches, and so many more ways.
Instance random_tree(Random& random, int vertices, int more, int robots) {
  std::vector<std::pair<int, int>> ways;
  for (int vertex = 1; vertex < vertices; ++vertex) {
    ways.push_back({random.below(3) > 0 ? vertex - 1 : random.below(vertex), vertex});
  }
  for (int k = 0; k < more; ++k) {
    const int a = random.below(vertices), b = random.below(vertices);
    if (a != b) ways.push_back({a, b});
  }
  std::vector<int> starts(vertices), goals(vertices);
  std::iota(starts.begin(), starts.end(), 0);
  std::iota(goals.begin(), goals.end(), 0);
  random.shuffle(starts);
  random.shuffle(goals);
  std::vector<Robot> all;
  for (int k = 0; k < robots; ++k) all.push_back(robot(starts[k], goals[k]));
  return two_way(vertices, ways, all);
}

/// Two rooms of four vertices with a corridor of so many between them, all but `empty` taken; one of the first
/// room is to change places with the last robot if `across`, else with another of the first.
Instance two_rooms(int corridor, int empty, bool across) {
  const int vertices = 8 + corridor;
  std::vector<std::pair<int, int>> ways{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  for (int k = 3; k < 4 + corridor; ++k) ways.push_back({k, k + 1});
  const int room = 4 + corridor;
  ways.insert(ways.end(), {{room, room + 1}, {room + 1, room + 2}, {room + 2, room + 3}, {room + 3, room}});
  std::vector<Robot> robots;
  for (int vertex = 0; vertex + empty < vertices; ++vertex) robots.push_back(robot(vertex, vertex));
  std::swap(robots[0].goals, (across ? robots.back() : robots[1]).goals);
  return two_way(vertices, ways, robots);
}

}  // namespace

TEST("no robot with a plan is reported, and on trees every instance without a plan is") {
  Random random(1);
  int solvable = 0, unsolvable = 0, seen = 0;
  for (int k = 0; k < 3'000; ++k) {
    const int vertices = 4 + random.below(4), more = k % 2 * random.below(3);
    const Instance it = random_tree(random, vertices, more, std::max(2, vertices - 1 - random.below(4)));
    const bool plan = least_makespan(it) >= 0, beyond = is_beyond_chain(it);
    CHECK(!plan || !beyond);
    if (more > 0) continue;
    (plan ? solvable : unsolvable) += 1;
    seen += beyond;
  }
  CHECK(solvable > 100 && unsolvable > 500);
  CHECK(seen == unsolvable);
}

TEST("two rooms exchange robots exactly if more vertices are empty than the corridor has") {
  for (int corridor = 0; corridor < 4; ++corridor) {
    for (int empty = 0; empty < 4; ++empty) {
      CHECK(is_beyond_chain(two_rooms(corridor, empty, true)) == (empty <= corridor));
      CHECK(!is_beyond_chain(two_rooms(corridor, empty, false)));
    }
  }
}

TEST("long chains and large trees are checked quickly") {
  CHECK(is_beyond_chain(two_rooms(100'000, 1'000, true)));
  Random random(2);
  CHECK(is_beyond_chain(random_tree(random, 200'000, 0, 199'990)));
}
