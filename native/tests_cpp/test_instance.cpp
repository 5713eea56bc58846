#include <stdexcept>

#include "check.hpp"
#include "grids.hpp"

using namespace mrpbench::mapf;

TEST("edges are indexed by both ends, self-loops left out") {
  const Roadmap roadmap(2, {0, 1, 0}, {1, 0, 0}, {1, 1, 1});
  CHECK(roadmap.out(0).size() == 1 && roadmap.out(0)[0] == 0);
  CHECK(roadmap.in(0).size() == 1 && roadmap.in(0)[0] == 1);
}

TEST("invalid roadmaps are refused") {
  CHECK(check::throws<std::invalid_argument>([] { Roadmap(2, {0}, {2}, {1}); }));
  CHECK(check::throws<std::invalid_argument>([] { Roadmap(2, {0}, {1}, {0}); }));
  CHECK(check::throws<std::invalid_argument>([] { Roadmap(2, {0}, {1}, {1, 1, 1}, {{0, 0}}); }));
}

TEST("invalid robots are refused") {
  const auto refused = [](Robot it) {
    return check::throws<std::invalid_argument>([&] { instance(grid(2, 1), {it}); });
  };
  CHECK(!refused(robot(0, 1)));
  CHECK(refused(robot(2, 1)));
  CHECK(refused(robot(0, -1)));
  Robot it = robot(0, 1);
  it.goals.clear();
  CHECK(refused(it));
  it = robot(0, 1);
  it.committed = {{0, 1, 2}};  // does not begin at tick 0
  CHECK(refused(it));
  it.committed = {{1, 0, 1}};  // begins at another vertex
  CHECK(refused(it));
  it.committed = {{0, 0, 1}};
  CHECK(!refused(it));
  it.ready = 1;
  CHECK(refused(it));
}

TEST("a beginning ends with the stay from which the robot is free to go on") {
  Robot it = robot(0, 2);
  it.committed = {{-1, 0, 2}, {0, 2, 5}, {-1, 5, 6}};
  const Instance one = instance(grid(3, 1), {it});
  const Beginning& beginning = one.beginning(0);
  CHECK(beginning.vertex == 1);
  CHECK(beginning.free_at == 6);
  CHECK((beginning.occupied == std::vector<Occupation>{at_vertex(0, 0, 2), on_edge(3, 2, 5), at_vertex(1, 5, 6)}));
}

TEST("segments begin with the committed ones and leave out empty waits") {
  Robot it = robot(0, 2);
  it.committed = {{-1, 0, 0}, {0, 0, 2}};
  const Instance one = instance(grid(3, 1), {it});
  const Path path{at_vertex(0, 0, 0), on_edge(3, 0, 2), at_vertex(1, 2, 4), on_edge(5, 4, 5), {2, 10, kForeverHalf}};
  const std::vector<Segment> found = segments(one, 0, path);
  CHECK(found.size() == 4);
  CHECK(found[1].edge == 0 && found[1].leave == 2);
  CHECK(found[2].edge == -1 && found[2].enter == 2 && found[2].leave == 4);
  CHECK(found[3].edge == 2 && found[3].leave == 5);
}
