#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/cbs/low_level/focal_search.hpp"
#include "mrpbench_mapf/cbs/low_level/mdd.hpp"

using namespace mrpbench::mapf;

namespace {

/// One robot among constraints.
struct Alone {
  explicit Alone(Instance given)
      : instance(std::move(given)),
        space(instance, limits),
        tables(instance, limits),
        table(space, limits),
        intervals(space, limits, statistics),
        search(space, intervals, limits, statistics),
        others(space, limits) {
    table.reset(0);
  }
  Tick cost() {
    const Tick cost = search.search(table, tables[0], others, {}, {}, 0, path);
    CHECK(cost == kForever || path.cost == cost);
    CHECK(intervals.least_cost(table, tables[0]) == cost);
    return cost;
  }
  Mdd mdd(Tick cost) { return MddBuilder(space, limits).build(table, tables[0], cost); }

  Instance instance;
  Limits limits = unlimited();
  Statistics statistics;
  Space space;
  DistanceTables tables;
  ConstraintTable table;
  SafeIntervals intervals;
  FocalSearch search;
  AvoidanceTable others;
  FoundPath path;
};

}  // namespace

TEST("a robot waits or takes a detour because of constraints") {
  Alone it(instance(grid(4, 1), {robot(0, 3)}));
  CHECK(it.cost() == 3);
  CHECK((it.path.at == std::vector<std::int32_t>{0, 1, 2, 3}));
  it.table.add(avoid_vertex(0, 2, 2, 2));
  CHECK(it.cost() == 4);
  it.table.add({0, 4 + edge_between(it.instance.roadmap(), 2, 3), {3, 5}});
  CHECK(it.cost() == 7);
}

TEST("a robot does not finish at a goal that is forbidden later") {
  Alone it(instance(grid(3, 1), {robot(0, 2)}));
  it.table.add(avoid_vertex(0, 2, 9, 9));
  CHECK(it.cost() == 10);
  it.table.add({0, 2, {11, 11}, Constraint::Kind::length_above});
  CHECK(it.cost() == 12);
  it.table.add({0, 2, {11, 11}, Constraint::Kind::length_at_most});
  CHECK(it.cost() == kForever);
}

TEST("no robot passes one that has finished for good") {
  Alone it(instance(grid(3, 1), {robot(0, 2), robot(2, 1)}));
  it.table.add({1, 1, {1, 1}, Constraint::Kind::length_at_most});
  CHECK(it.cost() == kForever);
  it.table.reset(0);
  it.table.add({1, 1, {2, 2}, Constraint::Kind::length_at_most});
  CHECK(it.cost() == 2);
}

TEST("a search for a goal that is blocked for good ends quickly in a large room") {
  Alone it(instance(grid(60, 60), {robot(0, 3599)}));
  it.table.add(avoid_vertex(0, 3598, 0, kForever));
  it.table.add(avoid_vertex(0, 3539, 500, kForever));
  it.table.add(avoid_vertex(0, 3599, 0, 600));
  CHECK(it.cost() == kForever);
  CHECK(it.statistics.low_level_expansions < 10'000);
}

TEST("edges of many ticks are crossed without a stop") {
  Alone it(instance(grid(3, 1, 5), {robot(0, 2)}));
  CHECK(!it.space.classical());
  CHECK(it.cost() == 10);
  it.table.add(avoid_vertex(0, 1, 5, 7));
  CHECK(it.cost() == 13);
  CHECK(it.path.occupied.size() == 5);
  CHECK(it.path.occupied[0] == at_vertex(0, 0, 3));
}

TEST("diagrams hold all shortest paths and no other") {
  Alone it(instance(grid(3, 3), {robot(0, 8)}));
  const Mdd mdd = it.mdd(4);
  CHECK(mdd.node_count() == 9);
  CHECK(mdd.width(2) == 3);
  CHECK(mdd.always_at(0, 0) && mdd.always_at(8, 4) && mdd.always_at(8, 9));
  CHECK(!mdd.always_at(4, 2));
  CHECK(mdd.find(4, 2) >= 0 && mdd.find(4, 3) < 0);
  ConstraintTable scratch(it.space, it.limits);
  const std::vector<Constraint> diagonal{avoid_vertex(0, 2, 2, 2), avoid_vertex(0, 4, 2, 2), avoid_vertex(0, 6, 2, 2)};
  CHECK(mdd.blocked_by(diagonal, scratch));
  CHECK(!mdd.blocked_by(std::span(diagonal).first(2), scratch));
}

TEST("constraints narrow the diagram") {
  Alone it(instance(grid(3, 2, 2), {robot(0, 2)}));
  CHECK(it.mdd(4).node_count() == 3);
  it.table.add(avoid_vertex(0, 1, 2, 2));
  CHECK(it.cost() == 5);
  const Mdd mdd = it.mdd(5);
  CHECK(mdd.node_count() == 4);  // waits at the start: one way only
  CHECK(mdd.always_at(1, 3));
}

TEST("conflicts with robots are counted until they are removed") {
  const Instance two = instance(grid(3, 1), {robot(0, 2), robot(2, 0)});
  Limits limits = unlimited();
  const Space space(two, limits);
  AvoidanceTable others(space, limits);
  const std::vector<std::int32_t> at{2, 1, 0};
  const TimedPath path{at, {}, 2};
  others.add(1, path);
  const Move& forth = space.moves(0, 0)[0];
  CHECK(others.waiting(0, 0, 0) == 0);
  CHECK(others.waiting(0, 0, 1) == 1);
  CHECK(others.waiting(0, 0, 50) == 1);
  CHECK(others.moving(0, 0, forth, 0) == 1);  // both come to vertex 1
  CHECK(others.moving(0, 0, forth, 1) == 1);  // they swap
  others.remove(1);
  CHECK(others.waiting(0, 0, 1) == 0);
  CHECK(others.moving(0, 0, forth, 1) == 0);
}
