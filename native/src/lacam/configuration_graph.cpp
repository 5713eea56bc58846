#include "lacam/configuration_graph.hpp"

#include <algorithm>

namespace mrpbench::mapf::lacam {

ConfigurationGraph::ConfigurationGraph(const Instance& instance, DistanceTables& tables, Objective objective,
                                       Limits& limits)
    : instance_(instance),
      tables_(tables),
      objective_(objective),
      limits_(limits),
      goals_(goals_of(instance)),
      robots_(limits),
      node_arena_(limits),
      steps_(limits),
      low_level_nodes_(limits),
      first_order_(first_order(instance, tables)),
      scratch_(first_order_),
      bucket_(1024) {}

std::uint64_t ConfigurationGraph::hash(Configuration at) const {
  std::uint64_t value = 0;
  for (int robot = 0; robot < instance_.size(); ++robot) {
    value = (std::rotl(value, 5) ^ static_cast<std::uint32_t>(at[robot])) * 0x9E3779B97F4A7C15ULL;
  }
  return value ^ value >> 32;
}

Node* ConfigurationGraph::find(Configuration at) const {
  Node* node = bucket_[hash(at) & (bucket_.size() - 1)];
  while (node != nullptr && !std::equal(at, at + instance_.size(), node->at)) node = node->next;
  return node;
}

Node& ConfigurationGraph::add(Configuration at, Node* parent) {
  if (nodes_.size() == bucket_.size()) grow();
  const std::int32_t* order = first_order_.data();
  if (parent != nullptr) {
    next_order(goals_, at, parent->order, first_order_, scratch_.data());
    order = scratch_.data();
  }
  const auto size = static_cast<std::size_t>(instance_.size());
  Node& node = node_arena_.copy(Node{.at = robots_.copy({at, size}).data(),
                                     .order = robots_.copy({order, size}).data(),
                                     .parent = parent,
                                     .steps = nullptr,
                                     .first_low_level = nullptr,
                                     .last_low_level = nullptr,
                                     .next = nullptr,
                                     .g = 0,
                                     .h = to_go(at),
                                     .id = static_cast<std::int32_t>(nodes_.size())});
  add_low_level_node(node, {nullptr, nullptr, -1, -1, 0});
  Node*& bucket = bucket_[hash(at) & (bucket_.size() - 1)];
  node.next = bucket;
  bucket = &node;
  nodes_.push_back(&node);
  limits_.charge_growth(counted_, (nodes_.capacity() + bucket_.size()) * sizeof(Node*));
  if (parent != nullptr) {
    add_step(*parent, node);
    node.g = parent->g + parent->steps->cost;
  }
  return node;
}

void ConfigurationGraph::add_step(Node& from, Node& to) {
  from.steps = &steps_.copy(Step{&to, from.steps, step_cost(from.at, to.at)});
}

void ConfigurationGraph::add_low_level_node(Node& node, const LowLevelNode& low_level) {
  LowLevelNode& added = low_level_nodes_.copy(low_level);
  if (node.first_low_level == nullptr) {
    node.first_low_level = &added;
  } else {
    node.last_low_level->next = &added;
  }
  node.last_low_level = &added;
}

const LowLevelNode* ConfigurationGraph::next_low_level_node(Node& node, const Moves& moves) {
  const LowLevelNode* next = node.first_low_level;
  if (next == nullptr) return nullptr;
  node.first_low_level = node.first_low_level->next;
  if (next->depth == instance_.size()) return next;
  const std::int32_t robot = node.order[next->depth];
  for (const std::int32_t vertex : moves.successors(robot, node.at[robot])) {
    add_low_level_node(node, {next, nullptr, robot, vertex, next->depth + 1});
  }
  add_low_level_node(node, {next, nullptr, robot, node.at[robot], next->depth + 1});
  return next;
}

/// For the sum of costs every tick counts that a robot does not spend at its goal: less than the sum of arrival times
/// if it leaves its goal again, but known from a step alone.
Cost ConfigurationGraph::step_cost(Configuration from, Configuration to) const {
  if (objective_ == Objective::makespan) return 1;
  Cost cost = 0;
  for (int robot = 0; robot < instance_.size(); ++robot) {
    cost += from[robot] != goals_[robot] || to[robot] != goals_[robot];
  }
  return cost;
}

Cost ConfigurationGraph::to_go(Configuration at) const {
  Cost sum = 0, most = 0;
  for (int robot = 0; robot < instance_.size(); ++robot) {
    const Cost distance = tables_[robot](at[robot]);
    sum += distance;
    most = std::max(most, distance);
  }
  return objective_ == Objective::makespan ? most : sum;
}

std::vector<Configuration> ConfigurationGraph::way_to(const Node& node) const {
  std::vector<Configuration> way;
  for (const Node* it = &node; it != nullptr; it = it->parent) way.push_back(it->at);
  std::reverse(way.begin(), way.end());
  return way;
}

void ConfigurationGraph::grow() {
  bucket_.assign(bucket_.size() * 4, nullptr);
  for (Node* node : nodes_) {
    Node*& bucket = bucket_[hash(node->at) & (bucket_.size() - 1)];
    node->next = bucket;
    bucket = node;
  }
}

}  // namespace mrpbench::mapf::lacam
