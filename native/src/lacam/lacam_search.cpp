#include "lacam/lacam_search.hpp"

#include <algorithm>

namespace mrpbench::mapf::lacam {

LacamSearch::LacamSearch(const Instance& instance, ConfigurationSpace& space, DistanceTables& tables,
                         const GuidePaths* guides, const LacamOptions& options, Limits& limits, Statistics& statistics)
    : moves_(space.moves()),
      limits_(limits),
      statistics_(statistics),
      step_(space.generator(tables, guides, options.swap, options.seed, limits)),
      graph_(instance, tables, options.objective, limits),
      goals_(goals_of(instance)),
      to_(instance.size()) {
  const auto start = space.start();
  if (!start) return;
  open_.push_back(&graph_.add(start->data(), nullptr));
  ++statistics_.generated;
}

bool LacamSearch::find_first() {
  while (!exhausted() && !advance()) {
  }
  return found();
}

bool LacamSearch::advance() {
  limits_.check_clock();
  Node& node = *open_.back();
  if (goal_ == nullptr && is_goal(goals_, node.at)) {
    goal_ = &node;
    return true;
  }
  const LowLevelNode* low_level = is_useful(node) ? graph_.next_low_level_node(node, moves_) : nullptr;
  if (low_level == nullptr) {
    open_.pop_back();
    return false;
  }
  ++statistics_.expansions;
  std::ranges::fill(to_, -1);
  for (; low_level->parent != nullptr; low_level = low_level->parent) to_[low_level->robot] = low_level->vertex;
  if (!(*step_)(node.at, node.order, to_.data())) return false;
  return visit(node);
}

/// Go on with the configuration that was reached from `node`.
bool LacamSearch::visit(Node& node) {
  Node* reached = graph_.find(to_.data());
  const Cost before = goal_ == nullptr ? 0 : goal_->g;
  if (reached == nullptr) {
    reached = &graph_.add(to_.data(), &node);
    ++statistics_.generated;
    open_.push_back(reached);
  } else {
    open_.push_back(reached);
    graph_.connect(node, *reached, [&](Node& cheaper) {
      if (goal_ != nullptr && &cheaper != goal_ && is_useful(cheaper)) open_.push_back(&cheaper);
    });
  }
  limits_.charge_growth(counted_, open_.capacity() * sizeof(Node*));
  return goal_ != nullptr && goal_->g < before;
}

}  // namespace mrpbench::mapf::lacam
