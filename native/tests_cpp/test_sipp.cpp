#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/single_agent/reservations.hpp"
#include "mrpbench_mapf/single_agent/sipp.hpp"

using namespace mrpbench::mapf;

namespace {

/// Obstacles as plain lists: what the robot must avoid at one vertex and on one edge.
struct Listed final : Obstacles {
  int vertex = -1, edge = -1;
  std::vector<Range> halves, departures;
  void at_vertex(int v, std::vector<Range>& out) const override {
    if (v == vertex) out.insert(out.end(), halves.begin(), halves.end());
  }
  void on_edge(int e, Tick, std::vector<Range>& out) const override {
    if (e == edge) out.insert(out.end(), departures.begin(), departures.end());
  }
};

struct Outcome {
  bool found;
  Path path;
};

Outcome search(const Instance& it, const Obstacles& obstacles, int who = 0, const Reservations* others = nullptr) {
  Limits limits = unlimited();
  Statistics statistics;
  DistanceTables tables(it, limits);
  Sipp sipp(it, limits, statistics);
  Path path;
  const bool found = sipp.search(who, tables, obstacles, path, others);
  return {found, path};
}

}  // namespace

TEST("without obstacles the path is the shortest") {
  const Instance it = instance(grid(3, 3, 2), {robot(0, 8)});
  const Outcome outcome = search(it, Listed{});
  CHECK(outcome.found);
  CHECK(arrival(outcome.path) == 8);
  CHECK(outcome.path.back().end == kForeverHalf);
}

TEST("the robot waits for a gap, at whole ticks") {
  const Instance it = instance(grid(3, 1), {robot(0, 2)});
  Listed obstacles;
  obstacles.vertex = 1;
  obstacles.halves = {{2, 7}, {9, 9}};  // tick 4 is free for an instant
  const Outcome outcome = search(it, obstacles);
  CHECK(outcome.found);
  CHECK(arrival(outcome.path) == 5);
  CHECK(outcome.path[0] == at_vertex(0, 0, 3));
  CHECK(outcome.path[2] == at_vertex(1, 4, 4));
}

TEST("the robot waits until adjacent ranges of forbidden departures end") {
  const Instance it = instance(grid(2, 1), {robot(0, 1)});
  Listed obstacles;
  obstacles.edge = edge_between(it.roadmap(), 0, 1);
  obstacles.departures = {{3, 4}, {0, 2}};
  CHECK(arrival(search(it, obstacles).path) == 6);
}

TEST("a robot does not finish at a goal that is blocked later") {
  const Instance stay = instance(grid(3, 1), {robot(0, 1)});
  Listed obstacles;
  obstacles.vertex = 1;
  obstacles.halves = {{20, 20}};
  CHECK(arrival(search(stay, obstacles).path) == 11);
  const Instance disappear =
      instance(grid(3, 1), {robot(0, 1)}, {.following_forbidden = false, .disappear_at_goal = true});
  CHECK(arrival(search(disappear, obstacles).path) == 1);
}

TEST("a goal that is blocked for good has no path") {
  Listed obstacles;
  obstacles.vertex = 2;
  obstacles.halves = {{40, kForeverHalf}};
  CHECK(!search(instance(grid(3, 1), {robot(0, 2)}), obstacles).found);
}

TEST("a robot that is at its goal never moves and costs nothing, ready or not") {
  Robot it = robot(1, 1);
  it.ready = 5;
  const Outcome outcome = search(instance(grid(3, 1), {it}), Listed{});
  CHECK(outcome.found);
  CHECK(arrival(outcome.path) == 0);
}

TEST("of two paths of equal duration, the one with fewer conflicts is taken") {
  const Instance it = instance(grid(2, 2), {robot(0, 3), robot(1, 1), robot(2, 2)});
  Limits limits = unlimited();
  const Relations relations(it, limits);
  for (int other = 1; other <= 2; ++other) {
    Reservations others(it, relations, limits);
    others.add(other, search(it, Listed{}, other).path);
    const Outcome outcome = search(it, Listed{}, 0, &others);
    CHECK(arrival(outcome.path) == 2);
    CHECK(outcome.path[2].element == 3 - other);
  }
}

TEST("reservations of others are avoided, swaps and overtaking included") {
  const Instance it = instance(grid(3, 2), {robot(0, 2), robot(2, 0)});
  Limits limits = unlimited();
  const Relations relations(it, limits);
  Reservations reservations(it, relations, limits);
  reservations.add(0, search(it, Listed{}, 0).path);
  CHECK(arrival(search(it, Others(reservations, 0), 0).path) == 2);  // its own do not matter
  CHECK(arrival(search(it, Others(reservations, 1), 1).path) == 4);  // through the other row
}
