// The search for one robot against plain dynamic programming over ticks, and its queue against a sorted list.
#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/bounded/focal_search.hpp"

using namespace mrpbench::mapf;

namespace {

using Steps_ = std::vector<std::int32_t>;

/// A random walk that ends at a vertex of its own.
Steps_ walk(const UnitRoadmap& roadmap, std::mt19937& random, int start, int length) {
  Steps_ steps{start};
  for (int i = 0; i < length; ++i) {
    const auto next = roadmap.successors(steps.back());
    const auto choice = random() % (next.size() + 1);
    steps.push_back(choice == next.size() ? steps.back() : next[choice]);
  }
  return steps;
}

/// By cost: the fewest conflicts of any path from start to goal that costs so much, for costs up to `latest`.
std::map<Tick, int> fewest_conflicts(const UnitRoadmap& roadmap, int start, int goal,
                                     const UnitConstraints& constraints, const PathTable& others, Tick latest) {
  constexpr int kNone = 1 << 20;
  const Tick end = std::max(latest, others.ticks()) + 1;
  std::map<Tick, int> result;
  std::vector<int> now(roadmap.vertex_count(), kNone);
  if (!constraints.forbids(start, start, 0)) now[start] = 0;
  for (Tick tick = 0; tick <= latest; ++tick) {
    std::vector<int> next(now.size(), kNone), moved(now.size(), kNone);
    for (int from = 0; from < roadmap.vertex_count(); ++from) {
      if (now[from] == kNone) continue;
      const auto go = [&](int to) {
        if (constraints.forbids(from, to, tick + 1)) return;
        const int conflicts = now[from] + others.count(from, to, tick);
        next[to] = std::min(next[to], conflicts);
        if (to != from) moved[to] = std::min(moved[to], conflicts);
      };
      go(from);
      for (const int to : roadmap.successors(from)) go(to);
    }
    const auto stay = [&](Tick since, int conflicts) {
      if (since < constraints.free_from(goal) || since > constraints.latest_arrival() || conflicts >= kNone) return;
      for (Tick t = since; t < end; ++t) conflicts += others.count(goal, goal, t);
      result[since] = conflicts;
    };
    if (tick == 0 && start == goal) stay(0, now[start]);
    stay(tick + 1, moved[goal]);
    now = next;
  }
  return result;
}

}  // namespace

TEST("a path costs at most w times its bound, which is exact, and meets as few others as any such path") {
  std::mt19937 random(7);
  int found = 0, none = 0;
  for (int round = 0; round < 600; ++round) {
    const Instance it = instance(grid(4, 3), {robot(0, 1)});
    const UnitRoadmap roadmap(it.roadmap(), 0);
    Limits limits = unlimited();
    Statistics statistics;
    BoundedOptions options;
    options.w = std::array{1.0, 1.3, 2.0, 4.0}[random() % 4];
    options.distance_weight = 1.0;
    options.conflict_weight = round % 2 ? 0.0 : 5.0;
    PathTable others(roadmap.vertex_count(), 3, limits);
    std::vector<Steps_> walks;
    std::vector<int> ends;
    for (int other = 0; other < 3; ++other) walks.push_back(walk(roadmap, random, random() % 12, random() % 9));
    for (int other = 0; other < 3; ++other) {
      if (std::ranges::find(ends, walks[other].back()) != ends.end()) continue;
      ends.push_back(walks[other].back());
      others.add(other, walks[other]);
    }
    const int start = random() % 12;
    int goal = random() % 12;
    while (std::ranges::find(ends, goal) != ends.end()) goal = (goal + 1) % 12;
    UnitConstraints constraints(roadmap.vertex_count(), limits);
    for (int i = random() % 8; i > 0; --i) {
      const Tick first = random() % 8;
      const int to = random() % 12;
      if (random() % 3 == 0) {
        constraints.forbid_move(roadmap.successors(to)[0], to, {first, first});
      } else {
        constraints.forbid_vertex(to, {first, random() % 9 == 0 ? kForever : first + static_cast<Tick>(random() % 3)});
      }
    }
    if (random() % 5 == 0) constraints.limit_arrival({static_cast<Tick>(random() % 7), kForever});
    if (random() % 5 == 0) constraints.limit_arrival({0, 6 + static_cast<Tick>(random() % 4)});

    FocalSearch search(roadmap, options, limits, statistics);
    UnitDistance distance(roadmap, goal, limits);
    Steps_ steps;
    const Tick least = search.search(start, goal, distance, constraints, others, {options.w}, 0, steps);
    const auto best = fewest_conflicts(roadmap, start, goal, constraints, others, 60);
    CHECK((least == kForever) == best.empty());
    if (best.empty()) {
      ++none;
      continue;
    }
    ++found;
    const Tick cost = static_cast<Tick>(steps.size()) - 1;
    CHECK(least <= best.begin()->first);
    CHECK(cost <= options.w * least);
    if (options.w == 1.0) CHECK(cost == best.begin()->first);
    CHECK(steps.front() == start && steps.back() == goal);
    int conflicts = 0;
    for (Tick tick = 0; tick < std::max(cost, others.ticks()); ++tick) {
      const int from = steps[std::min(tick, cost)], to = steps[std::min(tick + 1, cost)];
      CHECK(!constraints.forbids(from, to, tick + 1));
      conflicts += others.count(from, to, tick);
    }
    if (options.conflict_weight > 0.0) continue;
    int fewest = 1 << 20;
    for (const auto& [ticks, number] : best) {
      if (ticks <= options.w * least) fewest = std::min(fewest, number);
    }
    CHECK(conflicts == fewest);
  }
  CHECK(found > 300 && none > 10);
}

TEST("the queue hands out what a sorted list would") {
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
    for (int node = 0; node < 60; ++node) {
      Entry entry{least + static_cast<Tick>(random() % 9), static_cast<int>(random() % 5),
                  static_cast<int>(random() % 100)};
      if (node == 0) entry.f = 10;
      queue.push(node, entry.f, entry.row, entry.column);
      open[node] = entry;
      const auto place = std::next(open.begin(), random() % open.size());
      place->second.row = random() % 5;
      queue.update(place->first, place->second.row, place->second.column);
      if (random() % 2) continue;
      least = std::ranges::min_element(open, {}, [](const auto& it) { return it.second.f; })->second.f;
      CHECK(queue.least_f() == least);
      bound = std::max(bound, least + 3);
      queue.raise(bound);
      const auto key = [&](const auto& it) { return std::tuple(it.second.f > bound, it.second.row, it.second.column); };
      const auto first = key(*std::ranges::min_element(open, {}, key));
      const int popped = queue.pop();
      CHECK(open.contains(popped) && key(*open.find(popped)) == first);
      open.erase(popped);
      if (open.empty()) break;
    }
  }
}
