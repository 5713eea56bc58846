#include "check.hpp"
#include "mrpbench_mapf/infeasibility/rearrangement.hpp"
#include "mrpbench_mapf/infeasibility/solvability.hpp"
#include "plans.hpp"

using namespace mrpbench::mapf;

namespace {

std::optional<int> misplaced(const Instance& it) {
  Limits limits = unlimited();
  return find_misplaced_robot(it, limits);
}

/// Alone, or with the others.
bool proves_unsolvable(const Instance& it) {
  Limits limits = unlimited();
  DistanceTables tables(it, limits);
  return find_cut_off_robot(it, tables, limits).has_value() || misplaced(it).has_value();
}

/// Ways between `vertices` random vertices, some of them one-way.
Instance random_graph(Random& random, int vertices, int edges, int robots) {
  std::vector<int> tail, head, starts(vertices), goals(vertices);
  for (int k = 0; k < edges; ++k) {
    const int a = random.below(vertices), b = random.below(vertices);
    if (a == b) continue;
    tail.push_back(a), head.push_back(b);
    if (random.below(4) > 0) tail.push_back(b), head.push_back(a);
  }
  for (int vertex = 0; vertex < vertices; ++vertex) starts[vertex] = goals[vertex] = vertex;
  random.shuffle(starts);
  random.shuffle(goals);
  std::vector<Robot> all;
  for (int k = 0; k < robots; ++k) all.push_back(robot(starts[k], goals[k]));
  std::vector<Tick> duration(tail.size(), 1);
  return instance(Roadmap(vertices, tail, head, duration), all);
}

/// Two-way ways from each vertex to the next, closed to a cycle or not.
Instance line(int vertices, bool closed, std::vector<Robot> robots) {
  std::vector<int> tail, head;
  for (int k = 0; k + 1 < vertices + (closed ? 1 : 0); ++k) {
    const int next = (k + 1) % vertices;
    tail.insert(tail.end(), {k, next});
    head.insert(head.end(), {next, k});
  }
  std::vector<Tick> duration(tail.size(), 1);
  return instance(Roadmap(vertices, tail, head, duration), std::move(robots));
}

}  // namespace

TEST("with few arrangements, the check is exact") {
  Random random(1);
  int impossible = 0, possible = 0;
  for (int k = 0; k < 20'000; ++k) {
    const int robots = 2 + random.below(3), vertices = robots + random.below(3);
    const Instance it = k % 2 == 0 ? random_graph(random, vertices, vertices + random.below(4), robots)
                                   : random_instance(random, 3, 2, 2 + random.below(2));
    const bool plan = least_makespan(it) >= 0;
    CHECK(proves_unsolvable(it) == !plan);
    (plan ? possible : impossible) += 1;
  }
  CHECK(impossible > 4'000 && possible > 4'000);
}

TEST("robots keep their order on a path, however long it is") {
  CHECK(misplaced(line(5000, false, {robot(10, 4000), robot(4000, 10), robot(50, 60)})).has_value());
  CHECK(!misplaced(line(5000, false, {robot(10, 4000), robot(4000, 4999), robot(5, 0)})));
}

TEST("robots keep their cyclic order on a cycle") {
  CHECK(!misplaced(line(3000, true, {robot(1, 900), robot(2, 901), robot(3, 0)})));
  CHECK(misplaced(line(3000, true, {robot(1, 900), robot(2, 0), robot(3, 901)})).has_value());
  CHECK(!misplaced(line(3000, true, {robot(1, 900), robot(2, 0)})));
  CHECK(!misplaced(line(3, true, {robot(0, 1), robot(1, 2), robot(2, 0)})));
}

TEST("where following is forbidden, no robot moves on a full grid, and parity holds with one empty vertex") {
  const auto board = [](int last, bool exchanged, bool following_forbidden) {
    std::vector<Robot> robots;
    for (int vertex = 0; vertex <= last; ++vertex) robots.push_back(robot(vertex, vertex));
    if (exchanged) std::swap(robots[0].goals, robots[1].goals);
    return instance(grid(20, 20), robots, {.following_forbidden = following_forbidden});
  };
  CHECK(misplaced(board(399, true, true)).has_value());
  CHECK(misplaced(board(398, true, true)).has_value());
  CHECK(!misplaced(board(397, true, true)));
  CHECK(!misplaced(board(398, false, true)));
  CHECK(!misplaced(board(398, true, false)));
}

TEST("two robots can change places at a branch, and cases that the check does not cover stay open") {
  CHECK(!misplaced(instance(grid(200, 2), {robot(0, 199), robot(199, 0)})));
  const Rules gone{.disappear_at_goal = true};
  CHECK(!misplaced(instance(grid(4, 1), {robot(0, 3), robot(3, 0)}, gone)));
  CHECK(!misplaced(instance(grid(4, 1, 2), {robot(0, 3), robot(3, 0)})));
}
