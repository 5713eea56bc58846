#include "lacam/arrivals.hpp"

#include <map>
#include <queue>

namespace mrpbench::mapf::lacam {

namespace {

using Moving = std::uint64_t;  // robots that move later, as bits

struct Key {
  std::int32_t node;
  Moving moving;
  auto operator<=>(const Key&) const = default;
};

struct Reached {
  Cost cost;
  Key next;  // one tick later
};

struct Open {
  Cost cost;
  Key key;
  bool operator>(const Open& other) const { return cost != other.cost ? cost > other.cost : key > other.key; }
};

std::vector<std::vector<const Node*>> predecessors(const ConfigurationGraph& graph) {
  std::vector<std::vector<const Node*>> before(graph.nodes().size());
  for (const Node* node : graph.nodes()) {
    for (const Step* step = node->steps; step != nullptr; step = step->next) before[step->to->id].push_back(node);
  }
  return before;
}

Moving movers(Configuration from, Configuration to, int robots) {
  Moving moving = 0;
  for (int robot = 0; robot < robots; ++robot) moving |= static_cast<Moving>(from[robot] != to[robot]) << robot;
  return moving;
}

}  // namespace

std::vector<Configuration> least_arrivals(const ConfigurationGraph& graph, const Node& start, const Node& goal,
                                          int robots, Cost bound, Limits& limits) {
  const std::vector<std::vector<const Node*>> before = predecessors(graph);
  std::map<Key, Reached> reached;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto relax = [&](Key key, Cost cost, Key next) {
    const auto [place, is_new] = reached.try_emplace(key, Reached{cost, next});
    if (!is_new && place->second.cost <= cost) return;
    if (is_new) limits.charge(sizeof(Key) + sizeof(Reached) + 4 * sizeof(void*) + sizeof(Open));
    place->second = {cost, next};
    open.push({cost, key});
  };
  relax({goal.id, 0}, 0, {-1, 0});
  while (!open.empty()) {
    limits.check_clock();
    const Open best = open.top();
    open.pop();
    if (best.cost > reached.at(best.key).cost) continue;
    if (best.cost >= bound) return {};
    if (best.key.node == start.id) {
      std::vector<Configuration> way;
      for (Key key = best.key; key.node >= 0; key = reached.at(key).next) way.push_back(graph.nodes()[key.node]->at);
      return way;
    }
    const Configuration to = graph.nodes()[best.key.node]->at;
    for (const Node* from : before[best.key.node]) {
      const Moving moving = best.key.moving | movers(from->at, to, robots);
      relax({from->id, moving}, best.cost + std::popcount(moving), best.key);
    }
  }
  return {};
}

}  // namespace mrpbench::mapf::lacam
