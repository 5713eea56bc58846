// The search for one robot against plain dynamic programming over ticks, and its queue against a sorted list.
#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/cbs/constraints/conflict.hpp"
#include "mrpbench_mapf/cbs/low_level/focal_search.hpp"

using namespace mrpbench::mapf;

namespace {

/// A 4 x 3 raster whose edges take up to `longest` ticks.
Roadmap raster(std::mt19937& random, int longest) {
  const Roadmap plain = grid(4, 3);
  std::vector<int> tail, head;
  std::vector<Tick> duration;
  for (int edge = 0; edge < plain.edge_count(); ++edge) {
    tail.push_back(plain.tail(edge));
    head.push_back(plain.head(edge));
    duration.push_back(1 + static_cast<Tick>(random() % longest));
  }
  return Roadmap(12, std::move(tail), std::move(head), std::move(duration));
}

/// A random walk of `robot` from its start.
void walk(const Space& space, int robot, int length, std::mt19937& random, FoundPath& path) {
  std::vector<Stop> stops{{space.instance().beginning(robot).vertex, 0, -1}};
  for (int i = 0; i < length; ++i) {
    const auto [vertex, tick, edge] = stops.back();
    const auto moves = space.moves(robot, vertex);
    const auto choice = random() % (moves.size() + 1);
    if (choice == moves.size()) {
      stops.push_back({vertex, tick + 1, -1});
    } else {
      stops.push_back({moves[choice].head, tick + moves[choice].duration, moves[choice].edge});
    }
  }
  follow(space, robot, stops, path);
}

/// By cost: the fewest conflicts of any path of robot 0 that costs so much, for costs up to `latest`.
std::map<Tick, int> fewest_conflicts(const Space& space, const ConstraintTable& table, const AvoidanceTable& others,
                                     int goal, Tick latest) {
  constexpr int kNone = 1 << 20;
  std::map<Tick, int> result;
  std::vector<std::vector<int>> fewest(latest + 10, std::vector<int>(space.vertex_count(), kNone));
  if (!table.forbids_beginning()) fewest[0][space.instance().beginning(0).vertex] = 0;
  for (Tick tick = 0; tick <= latest; ++tick) {
    for (int from = 0; from < space.vertex_count(); ++from) {
      const int here = fewest[tick][from];
      if (here == kNone) continue;
      const auto reach = [&](int to, Tick arrive, int conflicts) {
        fewest[arrive][to] = std::min(fewest[arrive][to], here + conflicts);
      };
      if (!table.forbids_waiting(from, tick)) reach(from, tick + 1, others.waiting(0, from, tick));
      for (const Move& move : space.moves(0, from)) {
        if (table.forbids_entering(from, move.edge, tick) || table.forbids(move.head, tick + move.duration)) continue;
        reach(move.head, tick + move.duration, others.moving(0, from, move, tick));
      }
    }
    if (fewest[tick][goal] == kNone || tick < table.earliest_finish(goal) || tick > table.latest_finish()) continue;
    result[tick] = fewest[tick][goal] + others.staying(0, goal, tick);
  }
  return result;
}

/// Conflicts of a path of robot 0 that was found.
int count(const Space& space, const AvoidanceTable& others, const FoundPath& path) {
  Limits limits = unlimited();
  Arena<Constraint> constraints(limits);
  std::vector<Conflict> found;
  find_conflicts(space, others, 0, {path.at, path.occupied, path.cost, true}, constraints, found);
  return static_cast<int>(found.size());
}

}  // namespace

TEST("paths are the cheapest, or have the fewest conflicts within the bound, in short and long searches") {
  std::mt19937 random(7);
  int found = 0, none = 0;
  for (int round = 0; round < 2000; ++round) {
    const int longest = round % 3 == 0 ? 3 : 1;
    const int start = static_cast<int>(random() % 12);
    std::vector<Robot> robots{robot(start, static_cast<int>(random() % 12))};
    for (int k : {1, 4, 7}) robots.push_back(robot((start + k) % 12, 0));
    const Instance it = instance(raster(random, longest), robots);
    Limits limits = unlimited();
    Statistics statistics;
    const Space space(it, limits);
    const double w = std::array{1.0, 1.3, 2.0, 4.0}[random() % 4];
    const StateOrder order{.conflict_weight = round % 2 ? 0.0 : 5.0};
    AvoidanceTable others(space, limits);
    std::array<FoundPath, 4> walks;
    for (int other = 1; other < 4; ++other) {
      walk(space, other, static_cast<int>(random() % 9), random, walks[other]);
      others.add(other, {walks[other].at, walks[other].occupied, walks[other].cost, true});
    }
    others.refresh();
    const int goal = it.robots()[0].goals[0];
    ConstraintTable table(space, limits);
    table.reset(0);
    for (int i = random() % 8; i > 0; --i) {
      const Tick first = static_cast<Tick>(random() % 8);
      const int vertex = static_cast<int>(random() % 12);
      if (random() % 3 == 0) {
        table.add({0, 12 + space.moves(0, vertex)[0].edge, {first, first}});
      } else {
        table.add(
            avoid_vertex(0, vertex, first, random() % 9 == 0 ? kForever : first + static_cast<Tick>(random() % 3)));
      }
    }
    using Kind = Constraint::Kind;
    if (random() % 5 == 0) table.add({0, goal, {static_cast<Tick>(random() % 7), 0}, Kind::length_above});
    if (random() % 5 == 0) table.add({0, goal, {6 + static_cast<Tick>(random() % 4), 0}, Kind::length_at_most});

    SafeIntervals intervals(space, limits, statistics);
    const std::size_t patience = round % 4 < 2 ? 0 : 1024;
    FocalSearch search(space, intervals, limits, statistics, patience);
    DistanceTables distances(it, limits);
    FoundPath path;
    const Tick least = search.search(table, distances[0], others, order, {w}, 0, path);
    const auto best = fewest_conflicts(space, table, others, goal, 60);
    CHECK((least == kForever) == best.empty());
    const Tick cheapest = best.empty() ? kForever : best.begin()->first;
    CHECK(intervals.least_cost(table, distances[0]) == cheapest);
    if (best.empty()) {
      ++none;
      continue;
    }
    ++found;
    CHECK(least <= best.begin()->first);
    CHECK(path.cost <= w * least);
    if (w == 1.0) CHECK(path.cost == best.begin()->first);
    CHECK(best.contains(path.cost));
    if (longest > 1) continue;
    CHECK(path.at.front() == it.robots()[0].start && path.at.back() == goal);
    const int conflicts = count(space, others, path);
    CHECK(best.at(path.cost) <= conflicts);
    if (order.conflict_weight > 0.0) continue;
    int fewest = 1 << 20;
    for (const auto& [ticks, number] : best) {
      if (ticks <= w * least) fewest = std::min(fewest, number);
    }
    CHECK(conflicts == fewest);
  }
  CHECK(found > 300 && none > 10);
}

TEST("the queue returns the same entries as a sorted list, apart from outdated ones") {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    FocalQueue queue;
    struct Entry {
      Tick f;
      int row, column;
    };
    std::map<int, Entry> open;
    Tick bound = 10 + random() % 5, least = 10;
    queue.reset(10, bound);
    for (int entry = 0; entry < 60; ++entry) {
      Entry it{least + static_cast<Tick>(random() % 9), static_cast<int>(random() % 5),
               static_cast<int>(random() % 100)};
      if (entry == 0) it.f = 10;
      const auto known = std::next(open.begin(), open.empty() ? 0 : random() % open.size());
      if (random() % 3 == 0 && known != open.end() && known->second.row > 0) {
        it = {known->second.f, known->second.row - 1, it.column};  // the same state, reached in a better way
        open.erase(known);
      } else {
        queue.open(it.f);
      }
      queue.push(entry, it.f, it.row, it.column);
      open[entry] = it;
      if (random() % 2) continue;
      least = std::ranges::min_element(open, {}, [](const auto& it) { return it.second.f; })->second.f;
      CHECK(queue.least_f() == least);
      bound = std::max(bound, least + 3);
      queue.raise(bound);
      const auto key = [&](const auto& it) { return std::tuple(it.second.f > bound, it.second.row, it.second.column); };
      const auto first = key(*std::ranges::min_element(open, {}, key));
      int popped = queue.pop();
      while (!open.contains(popped)) popped = queue.pop();
      CHECK(key(*open.find(popped)) == first);
      queue.close(open[popped].f);
      open.erase(popped);
      CHECK(queue.empty() == open.empty());
      if (open.empty()) break;
    }
  }
}

TEST("the state table keeps all values while it grows, until it is cleared") {
  Limits limits = unlimited();
  StateTable table(limits);
  for (int round = 0; round < 3; ++round) {
    table.clear();
    for (int state = 0; state < 20'000; ++state) {
      std::int32_t& value = table(state % 100, state / 100);
      CHECK(value == StateTable::kUnknown);
      value = state;
    }
    for (int state = 0; state < 20'000; ++state) CHECK(table(state % 100, state / 100) == state);
  }
}
