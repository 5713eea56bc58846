#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/model/relations.hpp"

using namespace mrpbench::mapf;

namespace {

constexpr int kVertices = 4;

Relations relations(Rules rules, Exclusions exclusions = {}) {
  Limits limits = unlimited();
  return Relations(Instance(grid(4, 1), {}, rules, std::move(exclusions)), limits);
}

int lane(int tail, int head) {
  return kVertices + edge_between(grid(4, 1), tail, head);
}

}  // namespace

TEST("a vertex excludes itself, a lane its reverse, and one lane keeps its order") {
  const Relations related = relations({});
  CHECK(related.between(1, 1, 0.0) == Relation::exclusive);
  CHECK(related.between(1, 2, 0.0) == Relation::none);
  CHECK(related.between(lane(1, 2), lane(2, 1), 0.0) == Relation::exclusive);
  CHECK(related.between(lane(1, 2), lane(1, 2), 0.0) == Relation::ordered);
  CHECK(related.between(lane(1, 2), lane(2, 3), 0.0) == Relation::none);
  CHECK(related.between(lane(1, 2), 2, 0.0) == Relation::none);
}

TEST("following forbidden: lanes into and out of a vertex exclude one another") {
  const Relations related = relations({.following_forbidden = true, .disappear_at_goal = false});
  CHECK(related.between(lane(1, 2), lane(2, 3), 0.0) == Relation::exclusive);
  CHECK(related.between(lane(2, 3), lane(1, 2), 0.0) == Relation::exclusive);
  CHECK(related.between(lane(1, 2), lane(1, 2), 0.0) == Relation::exclusive);
  CHECK(related.between(lane(2, 1), lane(2, 3), 0.0) == Relation::none);
}

TEST("footprints exclude elements nearer than the reach of the two robots") {
  Exclusions exclusions;  // only vertices 0 and 1, 1 m apart
  exclusions.first = {0, 1, 2};
  exclusions.first.resize(static_cast<std::size_t>(grid(4, 1).element_count()) + 1, 2);
  exclusions.element = {1, 0};
  exclusions.distance = {1.0, 1.0};
  const Relations related = relations({}, exclusions);
  CHECK(related.between(0, 1, 1.0) == Relation::none);
  CHECK(related.between(0, 1, 1.1) == Relation::exclusive);
  CHECK(related.between(1, 0, 1.1) == Relation::exclusive);
  CHECK(related.between(0, 0, 0.0) == Relation::exclusive);
}
