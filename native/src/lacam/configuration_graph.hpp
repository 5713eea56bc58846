// The configurations that LaCAM* has seen, the steps between them, and the cheapest way to each.
#pragma once

#include <bit>
#include <deque>

#include "lacam/configurations.hpp"
#include "mrpbench_mapf/common/arena.hpp"
#include "mrpbench_mapf/model/objective.hpp"

namespace mrpbench::mapf::lacam {

struct Node;

/// A step to another configuration.
struct Step {
  Node* to;
  const Step* next;
  Cost cost;
};

/// What a successor must do: robot `robot` goes to `vertex`, and what `parent` says. The first one says nothing.
struct LowLevelNode {
  const LowLevelNode* parent;
  LowLevelNode* next;  // of the same configuration, to be tried after this one
  std::int32_t robot, vertex, depth;
};

struct Node {
  Configuration at;
  const std::int32_t* order;
  Node* parent;
  const Step* steps;
  LowLevelNode *first_low_level, *last_low_level;  // a queue
  Node* next;                                      // with the same hash
  Cost g, h;
  std::int32_t id;
};

class ConfigurationGraph {
 public:
  ConfigurationGraph(const Instance& instance, DistanceTables& tables, Objective objective, Limits& limits);

  /// The node of a configuration, or nullptr.
  Node* find(Configuration at) const;
  /// A node for a configuration that has none, reached from `parent` (nullptr: the start).
  Node& add(Configuration at, Node* parent);
  /// A step between known configurations, and what becomes cheaper by it: calls `cheaper(node)` for each.
  template <class Cheaper>
  void connect(Node& from, Node& to, Cheaper cheaper) {
    add_step(from, to);
    changed_.assign(1, &from);
    while (!changed_.empty()) {
      Node& node = *changed_.front();
      changed_.pop_front();
      for (const Step* step = node.steps; step != nullptr; step = step->next) {
        limits_.check();
        if (node.g + step->cost >= step->to->g) continue;
        step->to->g = node.g + step->cost;
        step->to->parent = &node;
        changed_.push_back(step->to);
        cheaper(*step->to);
      }
    }
  }
  /// The next low_level on successors of `node`, nullptr if there was every one; those that refine it are queued.
  const LowLevelNode* next_low_level_node(Node& node, const Moves& moves);

  std::vector<Configuration> way_to(const Node& node) const;
  const std::vector<Node*>& nodes() const { return nodes_; }

 private:
  std::uint64_t hash(Configuration at) const;
  Cost step_cost(Configuration from, Configuration to) const;
  Cost to_go(Configuration at) const;
  void add_step(Node& from, Node& to);
  void add_low_level_node(Node& node, const LowLevelNode& low_level);
  void grow();

  const Instance& instance_;
  DistanceTables& tables_;
  Objective objective_;
  Limits& limits_;
  std::vector<std::int32_t> goals_;
  Arena<std::int32_t> robots_;
  Arena<Node> node_arena_;
  Arena<Step> steps_;
  Arena<LowLevelNode> low_level_nodes_;
  std::vector<std::int32_t> first_order_, scratch_;
  std::vector<Node*> nodes_;
  std::vector<Node*> bucket_;
  std::deque<Node*> changed_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf::lacam
