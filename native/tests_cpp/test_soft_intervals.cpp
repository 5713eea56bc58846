#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/cbs/low_level/search_context.hpp"

using namespace mrpbench::mapf;

namespace {

/// A robot on a row of five vertices, with a bay (5) below vertex 1 and a resource that no robot needs.
struct Alone {
  Alone() : context(instance, {}, limits, statistics) { context.table.reset(0); }

  static Instance row() {
    std::vector<int> tail, head;
    for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {2, 3}, {3, 4}, {1, 5}}) {
      tail.insert(tail.end(), {a, b});
      head.insert(head.end(), {b, a});
    }
    std::vector<Tick> ticks(tail.size(), 1);
    return Instance(Roadmap(6, tail, head, ticks), {robot(0, 4), robot(2, 1)}, {}, {}, {{1, 0, {}}});
  }
  bool search(Tick latest, const AvoidanceTable* others = nullptr) {
    return context.soft_intervals->search(context.table, context.distances[0], others, latest, path);
  }

  Instance instance = row();
  Limits limits = unlimited();
  Statistics statistics;
  SearchContext context;
  FoundPath path;
};

/// Where the robot is, from when to when in ticks; moves are left out.
bool stands(const Path& path, int vertex, Tick first, Tick last) {
  for (const Occupation& it : path) {
    if (it.element == vertex && it.begin <= 2 * first && it.end >= 2 * last) return true;
  }
  return false;
}

}  // namespace

TEST("a path keeps the constraints and the latest cost") {
  Alone it;
  CHECK(it.search(4));
  CHECK(it.path.cost == 4);
  it.context.table.add(avoid_vertex(0, 2, 0, 9));
  CHECK(!it.search(11));
  CHECK(it.search(12));
  CHECK(it.path.cost == 12);
  it.context.table.add({0, 4, {12, 12}, Constraint::Kind::length_above});
  CHECK(!it.search(12));
  CHECK(it.search(13));
  CHECK(it.path.cost == 13);
  it.context.table.add({0, 4, {12, 12}, Constraint::Kind::length_at_most});
  CHECK(!it.search(12));
}

TEST("a robot that has to wait does so where it is in the way of none") {
  Alone it;
  it.context.table.add(avoid_vertex(0, 2, 0, 9));
  // The other robot is at vertex 0 from tick 0 to 3, then at 1 for good but for a visit to 2.
  const std::vector<Occupation> theirs{at_vertex(0, 0, 3), on_edge(6, 3, 4), at_vertex(1, 4, 8)};
  TimedPath other;
  other.occupied = theirs;
  other.stays = false;
  AvoidanceTable present(it.context.space, it.limits);
  present.add(1, other);
  present.refresh();
  CHECK(it.search(12, &present));
  CHECK(it.path.cost == 12);
  CHECK(stands(it.path.occupied, 5, 4, 8));
}

TEST("a robot at its goal that must finish later does not need to move") {
  Alone it;
  it.context.table.add({0, 4, {8, 8}, Constraint::Kind::length_above});
  CHECK(!it.search(8));
  CHECK(it.search(9));
  CHECK(it.path.cost == 9);
}
