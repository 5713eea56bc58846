// The search over configurations: LaCAM until the first plan, LaCAM* from then on.
#pragma once

#include <optional>

#include "lacam/configuration_graph.hpp"
#include "lacam/configuration_space.hpp"
#include "mrpbench_mapf/lacam/options.hpp"

namespace mrpbench::mapf::lacam {

class LacamSearch {
 public:
  LacamSearch(const Instance& instance, ConfigurationSpace& space, DistanceTables& tables, const GuidePaths* guides,
              const LacamOptions& options, Limits& limits, Statistics& statistics);

  /// Look for the first plan. False: there is none.
  bool find_first();
  /// Look at one more configuration. True if there is a new way to the goal: `way()`.
  bool advance();
  std::vector<Configuration> way() const { return graph_.way_to(*goal_); }
  bool found() const { return goal_ != nullptr; }
  /// Everything was seen that is on a way to the goal of less than `bound`.
  bool exhausted() const { return open_.empty(); }
  /// Ways that cost as much as this are of no interest.
  void bound(Cost cost) { bound_ = std::min(bound_, cost); }
  void drop_guide_paths() { step_->drop_guide_paths(); }
  const ConfigurationGraph& graph() const { return graph_; }
  const Node* goal() const { return goal_; }

 private:
  bool is_useful(const Node& node) const { return goal_ == nullptr || node.g + node.h < bound_; }
  bool visit(Node& node);

  const Moves& moves_;
  Limits& limits_;
  Statistics& statistics_;
  std::unique_ptr<ConfigurationGenerator> step_;
  ConfigurationGraph graph_;
  std::vector<std::int32_t> goals_, to_;
  std::vector<Node*> open_;  // the last one is next
  std::size_t counted_ = 0;
  Node* goal_ = nullptr;
  Cost bound_ = std::numeric_limits<Cost>::max();
};

}  // namespace mrpbench::mapf::lacam
