// Which node of a constraint tree to expand next so that the cost of the solution stays within w times the lower bound.
//   focal: among the nodes that are cheap enough, the one with the fewest conflicts (Barer et al., SoCS 2014).
//   explicit_estimation: the one with the fewest conflicts among those whose solutions are estimated to be cheap
//   enough,
//     if its own cost is; else the one with the least estimate, if its cost is; else the one with the least lower
//     bound, which raises the bound. Thayer and Ruml, "Bounded suboptimal search: a direct approach using inadmissible
//     estimates", IJCAI 2011; Li, Ruml and Koenig, "EECBS: a bounded-suboptimal search for multi-agent path finding",
//     AAAI 2021.
#pragma once

#include <set>
#include <tuple>
#include <vector>

#include "mrpbench_mapf/bounded/options.hpp"
#include "mrpbench_mapf/time.hpp"

namespace mrpbench::mapf {

/// What the queue knows of a node. `least` is a lower bound on all solutions below it.
struct Candidate {
  std::int32_t id;
  Cost least;
  Cost cost;
  std::int32_t conflicts;
};

/// How much dearer a node's solutions are than the node, learned from the steps that were taken so far: the global
/// error model of Thayer, Dionne and Ruml, "Learning inadmissible heuristics during search", ICAPS 2011.
class OnlineErrors {
 public:
  /// The better child of a node with `conflicts` costs `dearer` more and has `left` conflicts.
  void observe(Cost dearer, std::int32_t conflicts, std::int32_t left);
  double estimate(Cost cost, std::int32_t conflicts) const {
    return static_cast<double>(cost) + per_conflict_ * conflicts;
  }

 private:
  double cost_error_ = 0.0, distance_error_ = 0.0;
  std::int64_t observed_ = 0;
  double per_conflict_ = 0.0;
};

class NodeQueue {
 public:
  NodeQueue(Selection selection, double w) : selection_(selection), w_(w) {}

  bool empty() const { return by_least_.empty(); }
  std::size_t size() const { return by_least_.size(); }
  /// Lower bound on all solutions below the nodes that are in the queue.
  Cost least() const { return std::get<0>(*by_least_.begin()); }
  void push(const Candidate& node, double estimate);
  /// Take out the node to expand next.
  std::int32_t pop();
  /// Was the one popped last taken only because it had the least lower bound?
  bool popped_to_raise_the_bound() const { return to_raise_; }

 private:
  using Estimate = double;
  struct Entry {
    Candidate node;
    Estimate estimate;
  };
  using ByLeast = std::set<std::tuple<Cost, std::int32_t, std::int32_t>>;          // least, conflicts, -id
  using ByEstimate = std::set<std::tuple<Estimate, std::int32_t, std::int32_t>>;   // estimate, conflicts, -id
  using ByConflicts = std::set<std::tuple<std::int32_t, Estimate, std::int32_t>>;  // conflicts, estimate, -id

  double focal_bound() const;
  void update_focal();
  std::int32_t choose();
  bool affordable(std::int32_t id) const {
    return static_cast<double>(entries_[id].node.cost) <= w_ * static_cast<double>(least());
  }

  Selection selection_;
  double w_;
  std::vector<Entry> entries_;  // by id
  ByLeast by_least_;
  ByEstimate by_estimate_;
  ByConflicts focal_;
  bool to_raise_ = false;
  double bound_ = -1.0;  // nodes with estimates up to this are in `focal_`
};

}  // namespace mrpbench::mapf
