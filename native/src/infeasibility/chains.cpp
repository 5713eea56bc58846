#include "mrpbench_mapf/infeasibility/chains.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mrpbench_mapf/common/random.hpp"

namespace mrpbench::mapf {

namespace {

/// The vertices of a part in the order of a depth-first search. Those below a vertex follow it, up to `end`.
struct Tree {
  std::vector<std::vector<int>> neighbours;  // each once; all vertices by their number in this order
  std::vector<int> parent, end;
  std::vector<char> is_bridge;  // to the parent
  std::vector<char> on_cycle;
  std::vector<int> number;  // by vertex of the roadmap
};

/// Begins where no chain has an inner vertex. Bridges as by Tarjan, "A note on finding the bridges of a graph", IPL
/// 1974.
Tree grow_tree(const Roadmap& roadmap, std::span<const int> vertices, Limits& limits) {
  const auto size = static_cast<int>(vertices.size());
  Tree tree;
  limits.charge(vertices.size() * 64 + static_cast<std::size_t>(roadmap.vertex_count()) * sizeof(int));
  tree.number.assign(roadmap.vertex_count(), -1);
  tree.end.resize(size);
  const auto no_inner = [&](int vertex) { return roadmap.neighbours(vertex).size() != 2; };
  const auto root = std::ranges::find_if(vertices, no_inner);
  struct Visit {
    int number;
    std::size_t next;
  };
  std::vector<int> vertex;
  std::vector<Visit> open;
  const auto enter = [&](int at, int parent) {
    limits.check();
    const auto number = static_cast<int>(vertex.size());
    tree.number[at] = number;
    vertex.push_back(at);
    tree.parent.push_back(parent);
    tree.neighbours.push_back(roadmap.neighbours(at));
    open.push_back({number, 0});
  };
  enter(root == vertices.end() ? vertices.front() : *root, -1);
  while (!open.empty()) {
    Visit& top = open.back();
    if (top.next == tree.neighbours[top.number].size()) {
      tree.end[top.number] = static_cast<int>(vertex.size());
      open.pop_back();
      continue;
    }
    const int next = tree.neighbours[top.number][top.next++];
    if (tree.number[next] < 0) enter(next, top.number);
  }
  std::vector<int> lowest(size);
  tree.is_bridge.assign(size, false);
  tree.on_cycle.assign(size, false);
  for (int at = size - 1; at >= 0; --at) {
    lowest[at] = at;
    for (int& next : tree.neighbours[at]) {
      next = tree.number[next];
      if (next != tree.parent[at]) lowest[at] = std::min(lowest[at], tree.parent[next] == at ? lowest[next] : next);
    }
    tree.is_bridge[at] = lowest[at] == at && tree.parent[at] >= 0;
  }
  for (int at = 1; at < size; ++at) {
    if (!tree.is_bridge[at]) tree.on_cycle[at] = tree.on_cycle[tree.parent[at]] = true;
  }
  return tree;
}

/// Where all robots are: one to a vertex.
class Placing {
 public:
  explicit Placing(std::size_t vertices) : robot_(vertices, -1), count_(vertices + 1), sum_(vertices + 1) {}

  void put(int robot, int vertex) { robot_[vertex] = robot; }
  void sum_up(std::span<const std::uint64_t> name) {
    for (std::size_t k = 0; k < robot_.size(); ++k) {
      count_[k + 1] = count_[k] + (robot_[k] >= 0);
      sum_[k + 1] = sum_[k] + (robot_[k] >= 0 ? name[robot_[k]] : 0);
    }
  }
  int robot(int vertex) const { return robot_[vertex]; }
  int count(int begin, int end) const { return count_[end] - count_[begin]; }
  /// Of the names of the robots on vertices `begin` to `end`: the same for the same robots.
  std::uint64_t sum(int begin, int end) const { return sum_[end] - sum_[begin]; }

 private:
  std::vector<std::int32_t> robot_;  // by vertex
  std::vector<int> count_;
  std::vector<std::uint64_t> sum_;
};

/// What cannot change at a chain.
struct Division {
  std::uint64_t below;
  std::vector<int> between;
  bool operator==(const Division&) const = default;
};

/// `chain` from above to below; [begin, end) are the vertices below it.
Division divide(const Placing& at, std::span<const int> chain, int begin, int end, int empty,
                std::span<const std::uint64_t> name) {
  Division it{at.sum(begin, end), {}};
  int room = end - begin - at.count(begin, end), left = static_cast<int>(chain.size()) - empty;
  for (std::size_t k = chain.size(); k-- > 0;) {
    const int robot = at.robot(chain[k]);
    if (robot < 0) continue;
    if (room > 0) {
      it.below += name[robot];
      --room;
    } else if (left > 0) {
      it.between.push_back(robot);
      --left;
    }
  }
  return it;
}

}  // namespace

std::optional<int> find_robot_beyond_chain(const Instance& instance, std::span<const int> vertices,
                                           std::span<const int> robots, Limits& limits) {
  const Tree tree = grow_tree(instance.roadmap(), vertices, limits);
  std::vector<std::uint64_t> name(instance.size());
  Random random(1);
  for (std::uint64_t& it : name) it = random();
  Placing starts(vertices.size()), goals(vertices.size());
  for (const int robot : robots) {
    starts.put(robot, tree.number[instance.robots()[robot].start]);
    goals.put(robot, tree.number[instance.robots()[robot].goals.front()]);
  }
  starts.sum_up(name);
  goals.sum_up(name);
  const auto empty = static_cast<int>(vertices.size() - robots.size());
  // Where following is forbidden, no robot moves unless a vertex ahead is empty, so no cycle turns.
  const auto turns = [&](int at) { return tree.on_cycle[at] && !instance.rules().following_forbidden; };
  const auto is_inner = [&](int at) { return tree.neighbours[at].size() == 2 && !tree.on_cycle[at]; };
  std::vector<int> chain;
  for (int last = 1; last < static_cast<int>(vertices.size()); ++last) {
    if (!tree.is_bridge[last] || is_inner(last)) continue;
    limits.check();
    chain.clear();
    if (!turns(last)) chain.push_back(last);
    int top = tree.parent[last];
    for (; is_inner(top); top = tree.parent[top]) chain.push_back(top);
    if (!turns(top)) chain.push_back(top);
    if (static_cast<int>(chain.size()) < empty) continue;
    std::ranges::reverse(chain);
    const int begin = turns(last) ? last : last + 1;
    const Division before = divide(starts, chain, begin, tree.end[last], empty, name);
    const Division after = divide(goals, chain, begin, tree.end[last], empty, name);
    if (before != after) return robots.front();
  }
  return std::nullopt;
}

}  // namespace mrpbench::mapf
