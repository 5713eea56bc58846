#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/cbs/constraints/constraint.hpp"

using namespace mrpbench::mapf;

namespace {

/// A path on a line of vertices: pairs of (vertex, arrival), leaving at once unless a duration says otherwise.
Path along(const Roadmap& line, const std::vector<std::pair<int, Tick>>& stops, Tick duration) {
  Path path{at_vertex(stops[0].first, stops[0].second, stops[0].second)};
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const auto [vertex, arrive] = stops[i];
    path.back().end = 2 * (arrive - duration);
    const int edge = edge_between(line, stops[i - 1].first, vertex);
    path.push_back(on_edge(line.vertex_count() + edge, arrive - duration, arrive));
    path.push_back(at_vertex(vertex, arrive, arrive));
  }
  path.back().end = kForeverHalf;
  return path;
}

struct Case {
  Instance instance;
  Path one, other;
};

PairConflict conflict_of(const Case& it) {
  Limits limits = unlimited();
  const Relations relations(it.instance, limits);
  return find_conflict(it.instance, relations, 0, it.one, 1, it.other);
}

Case on_line(std::vector<std::pair<int, Tick>> one, Tick one_ticks, std::vector<std::pair<int, Tick>> other,
             Tick other_ticks) {
  Instance two = instance(grid(4, 1), {robot(0, 3), robot(3, 0)});
  Path first = along(two.roadmap(), one, one_ticks), second = along(two.roadmap(), other, other_ticks);
  return {std::move(two), std::move(first), std::move(second)};
}

bool contains(const Range& range, Tick tick) {
  return range.first <= tick && tick <= range.last;
}

}  // namespace

TEST("vertex conflicts are split at one instant") {
  const Case it = on_line({{0, 0}, {1, 1}}, 1, {{2, 0}, {1, 3}, {0, 4}}, 1);
  const PairConflict found = conflict_of(it);
  CHECK(found.count == 1);
  const auto [one, other] = split(found, it.one, it.other, 4, 0);
  CHECK(one.element == 1 && other.element == 1);
  CHECK(one.range.first == 6 && one.range.last == 6);
  CHECK(other.range.first == 6 && other.range.last == 6);
}

TEST("a vertex is constrained for as long as robots may be late") {
  const Instance late = instance(grid(4, 1), {robot(0, 3), robot(3, 0)}, {.k = 2});
  const Path one{at_vertex(1, 3, 5)}, soon{at_vertex(1, 7, 9)}, later{at_vertex(1, 8, 9)};
  CHECK(conflict_of({late, one, later}).count == 0);
  const PairConflict found = conflict_of({late, one, soon});
  CHECK(found.count == 1 && found.time == 14);
  for (const Constraint& it : split(found, one, soon, 4, 2)) CHECK(it.range.first == 10 && it.range.last == 14);
}

TEST("swaps are conflicts, following is none") {
  CHECK(conflict_of(on_line({{1, 0}, {2, 1}}, 1, {{2, 0}, {1, 1}}, 1)).count == 1);
  CHECK(conflict_of(on_line({{1, 0}, {2, 1}}, 1, {{0, 0}, {1, 1}}, 1)).count == 0);
}

TEST("a swap of long moves forbids every departure up to the other's arrival") {
  const Case it = on_line({{1, 0}, {2, 3}}, 3, {{2, 0}, {1, 4}}, 2);  // departures at 0 and 2
  const PairConflict found = conflict_of(it);
  CHECK(found.count == 1);
  const auto [one, other] = split(found, it.one, it.other, 4, 0);
  CHECK(one.range.first == 0 && one.range.last == 3);
  CHECK(other.range.first == 2 && other.range.last == 2);
}

TEST("overtaking on one lane is a conflict, keeping the order is none") {
  const Case overtaking = on_line({{1, 0}, {2, 6}}, 6, {{0, 0}, {1, 1}, {2, 4}}, 1);
  CHECK(conflict_of(overtaking).count == 2);  // 3 to 4 within 0 to 6, then it stands in front at vertex 2
  const Case behind = on_line({{1, 0}, {2, 3}, {3, 6}}, 3, {{0, 0}, {1, 1}, {2, 5}}, 1);
  CHECK(conflict_of(behind).count == 0);
}

TEST("all moves that the two constraints of a split forbid are in conflict") {
  // Each robot exists only while it is on the lane between 1 and 2, so that only the lane matters.
  const Tick latest = 5;  // of the second departure after the first
  for (const Tick k : {0, 1, 2}) {
    const Instance two = instance(grid(4, 1), {robot(0, 3), robot(3, 0)}, {.k = k});
    const auto move = [&](int afar, int tail, int head, Tick depart, Tick ticks) {
      const int lane = 4 + edge_between(two.roadmap(), tail, head);
      return Path{at_vertex(afar, 0, depart), on_edge(lane, depart, depart + ticks)};
    };
    int conflicts = 0;
    for (int i = 0; i < 4 * 4 * 2 * latest; ++i) {
      const Tick one_ticks = 1 + i % 4, other_ticks = 1 + i / 4 % 4, late = i / 32;
      const bool towards = i / 16 % 2 == 1;
      const auto at = [&](Tick d, Tick e) {
        return Case{two, move(0, 1, 2, d, one_ticks), move(3, towards ? 2 : 1, towards ? 1 : 2, e, other_ticks)};
      };
      const Case now = at(8, 8 + late);
      const PairConflict found = conflict_of(now);
      if (found.count == 0) continue;
      ++conflicts;
      const auto [one, other] = split(found, now.one, now.other, 4, k);
      CHECK(contains(one.range, 8) && contains(other.range, 8 + late));
      for (Tick d = one.range.first; d <= one.range.last; ++d) {
        for (Tick e = other.range.first; e <= other.range.last; ++e) CHECK(conflict_of(at(d, e)).count == 1);
      }
    }
    CHECK(conflicts > 40);
  }
}

TEST("the split of a stay and a passage forbids all passages during the stay") {
  // Vertex 0 is near the lane from 2 to 3, nothing else is near anything.
  const int lane = 4 + edge_between(grid(4, 1), 2, 3);
  Exclusions exclusions{{0}, {lane, 0}, {0.5, 0.5}};
  for (int x = 0; x < grid(4, 1).element_count(); ++x) {
    exclusions.first.push_back(exclusions.first.back() + (x == 0 || x == lane));
  }
  std::vector<Robot> robots{robot(0, 1), robot(2, 3)};
  for (Robot& it : robots) it.radius = 0.3;
  for (const Tick k : {0, 1, 2}) {
    const Instance two(grid(4, 1), robots, {.k = k}, exclusions);
    const int away = 4 + edge_between(two.roadmap(), 0, 1);
    int conflicts = 0;
    for (Tick leaves = 1; leaves <= 12; ++leaves) {
      for (Tick ticks = 1; ticks <= 4; ++ticks) {
        // Robot 0 stands at vertex 0 from `since` to `until`; robot 1 passes.
        const auto at = [&](Tick since, Tick until, Tick depart) {
          return Case{
              two,
              {at_vertex(1, 0, since - 1), on_edge(away, since - 1, since), at_vertex(0, since, until),
               on_edge(away, until, 40)},
              {at_vertex(2, 0, depart), on_edge(lane, depart, depart + ticks), at_vertex(3, depart + ticks, 40)}};
        };
        const Case now = at(1, leaves, 5);
        const PairConflict found = conflict_of(now);
        if (found.count == 0) continue;
        ++conflicts;
        const auto [stands, passes] = split(found, now.one, now.other, 4, k);
        CHECK(contains(passes.range, 5));
        CHECK(stands.range.first <= 2 * leaves && stands.range.last >= 2);
        for (Tick depart = passes.range.first; depart <= passes.range.last; ++depart) {
          for (Tick since = 1; since <= 12; ++since) {
            for (Tick until = since; until <= 12; ++until) {
              const bool forbidden = 2 * since <= stands.range.last && stands.range.first <= 2 * until;
              if (forbidden) CHECK(conflict_of(at(since, until, depart)).count == 1);
            }
          }
        }
      }
    }
    CHECK(conflicts == (7 + k) * 4);  // all that leave later than tick 5, or too soon before
  }
}
