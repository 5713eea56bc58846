// Which node of a constraint tree to expand next so that the cost of the solution stays within w times the lower bound.
//   focal: among the nodes that are cheap enough, the one with the fewest conflicts (Barer et al., SoCS 2014).
//   explicit_estimation: the one with the fewest conflicts among those whose solutions are estimated to be cheap
//     enough, if its own cost is; else the one with the least estimate, if its cost is; else the one with the least
//     lower bound, which raises the bound. Thayer and Ruml, "Bounded suboptimal search: a direct approach using
//     inadmissible estimates", IJCAI 2011; Li, Ruml and Koenig, "EECBS: a bounded-suboptimal search for multi-agent
//     path finding", AAAI 2021.
#pragma once

#include <set>
#include <tuple>

#include "mrpbench_mapf/cbs/options.hpp"
#include "mrpbench_mapf/cbs/tree/open_list.hpp"

namespace mrpbench::mapf {

/// By how much the solutions below a node cost more than the node, learned from previous expansions: the global error
/// model of Thayer, Dionne and Ruml, "Learning inadmissible heuristics during search", ICAPS 2011.
class OnlineErrors {
 public:
  void observe(const Candidate& node, const Candidate& better_child);
  double estimate(const Candidate& node) const {
    return static_cast<double>(node.cost) + per_conflict_ * node.conflicts;
  }

 private:
  double cost_error_ = 0.0, distance_error_ = 0.0;
  std::int64_t observed_ = 0;
  double per_conflict_ = 0.0;
};

class FocalList final : public OpenList {
 public:
  FocalList(Selection selection, double w, Limits& limits) : selection_(selection), w_(w), limits_(limits) {}

  void clear() override;
  bool empty() const override { return by_least_.empty(); }
  Cost least() const override { return std::get<0>(*by_least_.begin()); }
  void push(const Candidate& node) override;
  void push_root(std::int32_t id, Cost cost, std::int32_t conflicts) override;
  std::int32_t pop() override;
  bool popped_for_its_bound() const override { return to_raise_; }
  void learn(const Candidate& node, std::span<const Candidate> children) override;

 private:
  using Estimate = double;
  struct Entry {
    Candidate node;
    Estimate estimate;
  };
  using ByLeast = std::set<std::tuple<Cost, std::int32_t, std::int32_t>>;          // least, conflicts, -id
  using ByEstimate = std::set<std::tuple<Estimate, std::int32_t, std::int32_t>>;   // estimate, conflicts, -id
  using ByConflicts = std::set<std::tuple<std::int32_t, Estimate, std::int32_t>>;  // conflicts, estimate, -id

  void insert(const Candidate& node, double estimate);
  void update_focal();
  std::int32_t choose();
  bool affordable(std::int32_t id) const {
    return static_cast<double>(entries_[id].node.cost) <= w_ * static_cast<double>(least());
  }

  Selection selection_;
  double w_;
  Limits& limits_;
  OnlineErrors errors_;
  std::vector<Entry> entries_;  // by id
  ByLeast by_least_;
  ByEstimate by_estimate_;
  ByConflicts focal_;
  bool to_raise_ = false;
  double bound_ = -1.0;  // nodes with estimates up to this are in `focal_`
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
