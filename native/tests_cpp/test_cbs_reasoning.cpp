#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/cbs/tree/dependencies.hpp"
#include "root.hpp"

using namespace mrpbench::mapf;

namespace {

/// Two rooms of 2 x 2 joined by a corridor of `length` vertices.
Roadmap rooms(int length, Tick duration) {
  std::vector<int> tail, head;
  const auto lane = [&](int a, int b) {
    tail.insert(tail.end(), {a, b});
    head.insert(head.end(), {b, a});
  };
  for (const int room : {0, 4}) {
    lane(room, room + 1), lane(room, room + 2), lane(room + 1, room + 3), lane(room + 2, room + 3);
  }
  for (int k = 0; k <= length; ++k) lane(k == 0 ? 3 : 7 + k, k == length ? 4 : 8 + k);
  std::vector<Tick> ticks(tail.size(), duration);
  return Roadmap(8 + length, std::move(tail), std::move(head), std::move(ticks));
}

}  // namespace

TEST("a corridor makes one robot wait for its whole length") {
  for (const Tick duration : {1, 3}) {
    const Root root(instance(rooms(4, duration), {robot(1, 6), robot(5, 2)}));
    CHECK(!root.conflicts.empty());
    const Conflict& conflict = root.conflicts[0];
    CHECK(conflict.kind == Conflict::Kind::corridor);
    CHECK(conflict.cardinality == Conflict::Cardinality::both);
    // Each would leave after 6 edges; the later one enters when the earlier one has left, and needs 5 edges more.
    CHECK(conflict.branch[0][0] == avoid_vertex(0, 4, 0, 6 * duration + 5 * duration));
    CHECK(conflict.branch[1][0] == avoid_vertex(1, 3, 0, 6 * duration + 5 * duration));
  }
}

TEST("rectangle constraints are on the borders of the region that two robots cross") {
  // One from the left to the right, one from the top to the bottom; all their paths meet.
  const Root root(instance(grid(5, 5), {robot(5, 19), robot(1, 23)}), {.corridor = false});
  bool rectangle = false;
  for (const Conflict& conflict : root.conflicts) {
    if (conflict.kind != Conflict::Kind::rectangle) continue;
    rectangle = true;
    CHECK(conflict.cardinality == Conflict::Cardinality::both);
    CHECK(conflict.branch[0].size() > 1);
  }
  CHECK(rectangle);
}

TEST("a robot at its goal finishes later, or stays there for good") {
  const Root root(instance(grid(5, 1), {robot(1, 2), robot(0, 4)}));
  bool target = false;
  for (const Conflict& conflict : root.conflicts) {
    if (conflict.kind != Conflict::Kind::target) continue;
    target = true;
    CHECK(conflict.branch[0][0].kind == Constraint::Kind::length_above);
    CHECK(conflict.branch[1][0].kind == Constraint::Kind::length_at_most);
    CHECK(conflict.branch[0][0].range.first == 2);
    CHECK(conflict.cardinality == Conflict::Cardinality::both);
  }
  CHECK(target);
}

namespace {

/// Two robots that drive side by side through a resource of both lanes, which takes 3 ticks to be ready again.
Instance gate() {
  Roadmap road = grid(5, 2);
  std::vector<int> elements{2, 7};
  for (int edge = 0; edge < road.edge_count(); ++edge) {
    for (const int vertex : {2, 7}) {
      if (road.tail(edge) == vertex || road.head(edge) == vertex) elements.push_back(10 + edge);
    }
  }
  return Instance(std::move(road), {robot(0, 4), robot(5, 9)}, {}, {}, {{1, 3, elements}});
}

}  // namespace

TEST("of two robots that use a resource, one enters it once the other could have left it") {
  const Root root(gate());
  CHECK(root.conflicts.size() == 1);
  const Conflict& conflict = root.conflicts[0];
  CHECK(conflict.kind == Conflict::Kind::precedence);
  CHECK(conflict.cardinality == Conflict::Cardinality::both);
  for (int robot = 0; robot < 2; ++robot) {
    // The other one comes out at tick 3, and the resource is in use until the half-tick before tick 6.
    CHECK((conflict.branch[robot][0] == Constraint{robot, 0, {0, 11}, Constraint::Kind::resource}));
  }
}

TEST("a robot that is under way may have left a resource before, so that no order is decided on") {
  Instance it = gate();
  std::vector<Robot> robots = it.robots();
  robots[0].committed = {{edge_between(it.roadmap(), 0, 1), 0, 1}};
  const Root root(Instance(it.roadmap(), robots, {}, {}, it.resources()));
  CHECK(!root.conflicts.empty());
  for (const Conflict& conflict : root.conflicts) CHECK(conflict.kind == Conflict::Kind::standard);
}

TEST("without reasoning, conflicts are resolved by the standard constraints") {
  const CbsOptions off{.target = false, .corridor = false, .rectangle = false, .precedence = false};
  const Root root(instance(rooms(4, 1), {robot(1, 6), robot(5, 2)}), off);
  for (const Conflict& conflict : root.conflicts) CHECK(conflict.kind == Conflict::Kind::standard);
  const Root other(gate(), off);
  for (const Conflict& conflict : other.conflicts) CHECK(conflict.kind == Conflict::Kind::standard);
}

TEST("the pair heuristic returns what a node still costs, or that it has no solution") {
  Root root(instance(rooms(4, 1), {robot(1, 6), robot(5, 2)}));
  Dependencies dependencies(root.context);
  std::vector<const Conflict*> conflicts;
  for (const Conflict& conflict : root.conflicts) conflicts.push_back(&conflict);
  CHECK(dependencies.evaluate(root.state, conflicts) == 6);
  // There is no solution if each robot must have finished before the other one can have passed.
  root.state.add({0, 6, {7, 7}, Constraint::Kind::length_at_most});
  root.state.add({1, 2, {7, 7}, Constraint::Kind::length_at_most});
  CHECK(dependencies.evaluate(root.state, conflicts) == Dependencies::kImpossible);
}
