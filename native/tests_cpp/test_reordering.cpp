#include <optional>
#include <random>

#include "check.hpp"
#include "grids.hpp"
#include "mrpbench_mapf/reordering/gses.hpp"
#include "reordering/local_search.hpp"

using namespace mrpbench::mapf;

namespace {

/// Robots that visit random places; each pair of visits of a place has alternatives, in the order of a random plan.
AlternativeGraph drawn(std::mt19937& random, int robots, int places) {
  const auto draw = [&](int from, int to) { return from + static_cast<int>(random() % (to - from + 1)); };
  struct Visit {
    int robot, event, time, place;
    bool first, last;
  };
  AlternativeGraph graph;
  graph.first = {0};
  std::vector<Visit> visits;
  for (int robot = 0; robot < robots; ++robot) {
    const int length = draw(1, 4);
    int time = draw(0, 3);
    for (int k = 0; k < length; ++k, time += draw(1, 3)) {
      visits.push_back({robot, graph.first.back() + k, time, draw(0, places - 1), k == 0, k == length - 1});
      graph.duration.push_back(draw(1, 3) + (draw(0, 4) == 0 ? 10 : 0));
    }
    graph.first.push_back(static_cast<int>(graph.duration.size()));
  }
  for (const Visit& one : visits) {
    for (const Visit& other : visits) {
      if (one.place != other.place || one.robot == other.robot) continue;
      if (std::tie(one.time, one.robot) > std::tie(other.time, other.robot) || one.last || other.first) continue;
      const Arc planned{one.event + 1, other.event, draw(1, 2)};
      if (one.first || other.last) {
        graph.fixed.push_back(planned);
      } else {
        graph.alternatives.push_back({planned, {other.event + 1, one.event, draw(1, 2)}});
      }
    }
  }
  return graph;
}

/// The least cost of all orders, and nothing if each of them is a cycle.
std::optional<Cost> by_enumeration(const AlternativeGraph& graph) {
  std::optional<Cost> best;
  std::vector<char> switched(graph.alternatives.size());
  for (std::uint32_t code = 0; code < 1U << switched.size(); ++code) {
    for (std::size_t k = 0; k < switched.size(); ++k) switched[k] = code >> k & 1;
    const Cost cost = cost_of_order(graph, switched);
    if (cost >= 0 && (!best || cost < *best)) best = cost;
  }
  return best;
}

}  // namespace

TEST("the order found is the best of all") {
  std::mt19937 random(1);
  int with_choice = 0, impossible = 0;
  for (int round = 0; round < 3000; ++round) {
    const AlternativeGraph graph = drawn(random, 2 + round % 5, 2 + round % 4);
    if (graph.alternatives.size() > 12) continue;
    Limits limits = unlimited();
    const Reordering found = solve_gses(graph, limits);
    const auto best = by_enumeration(graph);
    CHECK(found.status == (best ? Status::solved : Status::unsolvable));
    CHECK(found.cost == best.value_or(-1));
    if (!best) {
      ++impossible;
      continue;
    }
    CHECK(found.lower_bound == *best);
    CHECK(cost_of_order(graph, found.switched) == *best);
    with_choice += found.planned_cost != *best;
  }
  CHECK(with_choice > 100);
  CHECK(impossible > 100);
}

TEST("local search ends where no decision helps that is switched with those it implies") {
  std::mt19937 random(4);
  int improved = 0;
  for (int round = 0; round < 1000; ++round) {
    const AlternativeGraph graph = drawn(random, 4 + round % 9, 3 + round % 9);
    const Cost planned_cost = cost_of_order(graph, std::vector<char>(graph.alternatives.size()));
    if (planned_cost < 0) continue;
    const Decisions decisions(graph);
    const ArcIndex arcs(graph, decisions);
    const auto cost = [&](const std::vector<Side>& sides) {
      std::vector<char> switched;
      for (std::size_t k = 0; k < graph.alternatives.size(); ++k) {
        switched.push_back(sides[decisions.planned(k).decision] != decisions.planned(k).side);
      }
      return cost_of_order(graph, switched);
    };
    Limits limits = unlimited();
    LocalSearch search(graph, decisions, arcs, decisions.planned_sides(), limits);
    search.run(1 << 30);
    CHECK(search.cost() == cost(search.sides()));
    improved += search.cost() < planned_cost;
    for (int decision = 0; decision < decisions.count(); ++decision) {
      std::vector<Side> sides = search.sides();
      std::vector<Choice> todo = {{decision, static_cast<Side>(1 - sides[decision])}};
      while (!todo.empty()) {
        const Choice choice = todo.back();
        todo.pop_back();
        if (sides[choice.decision] == choice.side) continue;
        sides[choice.decision] = choice.side;
        for (const std::int32_t other : decisions.implied(choice)) todo.push_back({other, choice.side});
      }
      const Cost other = cost(sides);
      CHECK(other < 0 || other >= search.cost());
    }
  }
  CHECK(improved > 30);
}

TEST("a search without time keeps the planned order, and bounds it") {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const AlternativeGraph graph = drawn(random, 12, 6);
    Limits none(0.0, 1 << 30), enough = unlimited();
    const Reordering hurried = solve_gses(graph, none), found = solve_gses(graph, enough);
    CHECK(hurried.planned_cost == found.planned_cost);
    if (hurried.planned_cost < 0) continue;
    CHECK(hurried.cost == cost_of_order(graph, hurried.switched));
    CHECK(found.cost <= hurried.cost && hurried.cost <= hurried.planned_cost);
    CHECK(hurried.lower_bound <= found.cost);
  }
}

TEST("a search of little work finds the same order again, and bounds it") {
  std::mt19937 random(3);
  int limited = 0;
  for (int round = 0; round < 1000; ++round) {
    const AlternativeGraph graph = drawn(random, 2 + round % 5, 2 + round % 4);
    Limits enough = unlimited(), one = unlimited(), other = unlimited();
    const Reordering found = solve_gses(graph, enough);
    if (found.planned_cost < 0) continue;
    const Reordering few = solve_gses(graph, one, round % 40), again = solve_gses(graph, other, round % 40);
    CHECK(few.switched == again.switched && few.lower_bound == again.lower_bound);
    CHECK(few.work >= round % 40 || few.status != Status::timeout);
    CHECK(few.cost == cost_of_order(graph, few.switched) && few.cost <= few.planned_cost);
    CHECK(few.lower_bound <= found.cost && found.cost <= few.cost);
    limited += few.status == Status::timeout;
  }
  CHECK(limited > 10);
}

TEST("graphs that make no sense are refused") {
  const AlternativeGraph sound{{0, 2, 4}, {1, 1, 1, 1}, {}, {{{1, 2, 1}, {3, 0, 1}}}};
  const auto refused = [](AlternativeGraph graph) {
    return check::throws<std::invalid_argument>([&] { graph.check(); });
  };
  CHECK(!refused(sound));
  AlternativeGraph graph = sound;
  graph.alternatives[0].switched = {1, 2, 1};
  CHECK(refused(graph));
  graph = sound;
  graph.fixed = {{0, 4, 1}};
  CHECK(refused(graph));
  graph.fixed = {{0, 1, 1}};
  CHECK(refused(graph));
  graph.fixed = {{0, 2, 0}};
  CHECK(refused(graph));
  graph = sound;
  graph.duration[2] = 0;
  CHECK(refused(graph));
  graph = sound;
  graph.first = {0, 0, 4};
  CHECK(refused(graph));
}
