#include "check.hpp"
#include "grids.hpp"
#include "root.hpp"

using namespace mrpbench::mapf;

namespace {

constexpr Tick kLane = 10;

/// Lanes of ten ticks, both ways, between vertex 0 and the vertices 1 to 4, and from 2 on to 5.
Roadmap star() {
  return Roadmap(6, {0, 1, 0, 2, 0, 3, 0, 4, 2, 5}, {1, 0, 2, 0, 3, 0, 4, 0, 5, 2}, std::vector<Tick>(10, kLane));
}

/// Elements that touch exclude one another.
Exclusions touching(const Roadmap& roadmap) {
  const int vertices = roadmap.vertex_count();
  const auto ends = [&](int element) {
    const int edge = element - vertices;
    return edge < 0 ? std::pair(element, element) : std::pair(roadmap.tail(edge), roadmap.head(edge));
  };
  Exclusions result{{0}, {}, {}};
  for (int one = 0; one < roadmap.element_count(); ++one) {
    for (int other = 0; other < roadmap.element_count(); ++other) {
      const auto [a, b] = ends(one);
      const auto [c, d] = ends(other);
      if (a != c && a != d && b != c && b != d) continue;
      result.element.push_back(other);
      result.distance.push_back(0.0);
    }
    result.first.push_back(static_cast<std::int64_t>(result.element.size()));
  }
  return result;
}

Robot large(int start, int goal, Tick ready = 0) {
  Robot it = robot(start, goal);
  it.radius = 0.2;
  it.ready = ready;
  return it;
}

Root on_star(std::vector<Robot> robots) {
  Roadmap roadmap = star();
  Exclusions exclusions = touching(roadmap);
  return Root(Instance(std::move(roadmap), std::move(robots), {}, std::move(exclusions)));
}

Tick least_cost(Root& root, int robot, std::span<const Constraint> constraints) {
  for (const Constraint& constraint : constraints) root.state.add(constraint);
  root.state.set_path(robot, root.state.path(robot), 0);
  const Tick cost = root.context.least_cost(root.state, robot);
  root.state.clear_constraints();
  return cost;
}

}  // namespace

TEST("of two robots that cross, the later one comes when the other has left the junction") {
  Root root = on_star({large(1, 2), large(3, 4, 5)});
  CHECK(root.conflicts.size() == 1);  // however many elements they exclude one another from
  const Conflict& conflict = root.conflicts[0];
  const Half leaves = 2 * 2 * kLane - 1;
  CHECK((conflict.branch[0][0] == Constraint{0, 0, {leaves, leaves}, Constraint::Kind::junction}));
  CHECK((conflict.branch[1][0] == Constraint{1, 0, {leaves, leaves}, Constraint::Kind::junction}));
  CHECK(conflict.cardinality == Conflict::Cardinality::both);
  CHECK(least_cost(root, 0, conflict.branch[0]) == 4 * kLane);
  CHECK(least_cost(root, 1, conflict.branch[1]) == 4 * kLane);
}

TEST("a robot that waits on a junction is constrained at an instant by which it cannot have left") {
  Root root = on_star({large(1, 5, 20), large(3, 4, 35)});
  // It could leave at 40, but waits at the junction until 42, since it must not finish before 62.
  root.state.add({0, 5, {61, 61}, Constraint::Kind::length_above});
  const Space& space = root.context.space;
  FoundPath path;
  const auto edge = [&](int tail, int head) { return edge_between(root.instance.roadmap(), tail, head); };
  const std::array<Stop, 5> stops{
      {{1, 20, -1}, {0, 30, edge(1, 0)}, {0, 42, -1}, {2, 52, edge(0, 2)}, {5, 62, edge(2, 5)}}};
  follow(space, 0, stops, path);
  root.state.set_path(0, root.paths.keep(path));
  AvoidanceTable present(space, root.limits);
  present.add(1, root.state.path(1));
  present.refresh();
  root.conflicts.clear();
  find_conflicts(space, present, 0, root.state.path(0), root.constraints, root.conflicts);
  CHECK(root.conflicts.size() == 1);
  Conflict& conflict = root.conflicts[0];
  CHECK((conflict.branch[0][0].range == Range{2 * 52 - 1, 2 * 52 - 1}));  // its present last instant there
  root.reasoning.examine(root.state, conflict);
  CHECK(conflict.cardinality == Conflict::Cardinality::both);
  CHECK((conflict.branch[0][0] == Constraint{0, 0, {2 * 40 - 1, 2 * 40 - 1}, Constraint::Kind::junction}));
  CHECK((conflict.branch[1][0] == Constraint{1, 0, {2 * 40 - 1, 2 * 40 - 1}, Constraint::Kind::junction}));
}

TEST("a junction constraint forbids the vertex and all edges that end there") {
  Root root = on_star({large(1, 2), large(3, 4)});
  ConstraintTable table(root.context.space, root.limits);
  table.reset(0);
  table.add({0, 0, {2 * 30, 2 * 30}, Constraint::Kind::junction});
  CHECK(table.forbids(0, 30) && !table.forbids(0, 29) && !table.forbids(0, 31));
  const Roadmap& roadmap = root.instance.roadmap();
  for (int leaf = 1; leaf <= 4; ++leaf) {
    for (const auto& [tail, head] : {std::pair(0, leaf), std::pair(leaf, 0)}) {
      const int edge = edge_between(roadmap, tail, head);
      for (Tick tick = 0; tick <= 40; ++tick) {
        CHECK(table.forbids_entering(tail, edge, tick) == (tick < 30 && 30 < tick + kLane));
      }
    }
    CHECK(!table.forbids(leaf, 30));
  }
}

TEST("a robot that has arrived where another one passes finishes after the whole passage, or before all of it") {
  Root root = on_star({large(1, 0), large(3, 4, 30)});
  CHECK(root.conflicts.size() == 1);
  const Conflict& conflict = root.conflicts[0];
  CHECK(conflict.kind == Conflict::Kind::target);
  const Tick last = 30 + 2 * kLane - 1;  // of the passage
  CHECK((conflict.branch[0][0] == Constraint{0, 0, {last, last}, Constraint::Kind::length_above}));
  CHECK((conflict.branch[1][0] == Constraint{0, 0, {last, last}, Constraint::Kind::length_at_most}));
}

TEST("a vertex at which robots may pass one another is no junction") {
  const Root points(instance(star(), {robot(1, 2), robot(3, 4)}));
  CHECK(!points.context.space.is_junction(0));
  Root large_ones = on_star({large(1, 2), large(3, 4)});
  CHECK(large_ones.context.space.is_junction(0));
  Roadmap roadmap = star();
  Exclusions exclusions = touching(roadmap);
  for (double& distance : exclusions.distance) distance = 0.3;  // less than two large robots, more than a small one
  std::vector<Robot> robots{large(1, 2), large(3, 4), robot(2, 1)};
  const Root mixed(Instance(std::move(roadmap), std::move(robots), {}, std::move(exclusions)));
  CHECK(!mixed.context.space.is_junction(0));
}
