// Which node of a constraint tree to expand next.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

/// What an open list knows of a node.
struct Candidate {
  std::int32_t id;
  Cost least;      // a lower bound on all solutions below the node
  Cost heuristic;  // the part of `least` that comes from pairs of robots
  Cost cost;
  std::int32_t conflicts;
};

class OpenList {
 public:
  virtual ~OpenList() = default;
  virtual void clear() = 0;
  virtual bool empty() const = 0;
  /// A lower bound on all solutions below the nodes in the list, which must not be empty.
  virtual Cost least() const = 0;
  virtual void push(const Candidate& node) = 0;
  /// Add a root that is made when its turn comes. No solution below it costs less than `cost`; the root before it has
  /// `conflicts`.
  virtual void push_root(std::int32_t id, Cost cost, std::int32_t conflicts) = 0;
  /// Take out the node to expand next.
  virtual std::int32_t pop() = 0;
  /// Tell whether the last node was taken out for its lower bound, so that a higher bound puts other nodes first.
  virtual bool popped_for_its_bound() const = 0;
  /// Learn from the `children` that a node has, if any.
  virtual void learn(const Candidate& /*node*/, std::span<const Candidate> /*children*/) {}
};

/// The least lower bound first; among equals the fewest conflicts, then the least heuristic, then the newest node.
class BestFirst final : public OpenList {
 public:
  explicit BestFirst(Limits& limits) : limits_(limits) {}

  void clear() override { open_.clear(); }
  bool empty() const override { return open_.empty(); }
  Cost least() const override { return open_.front().node.least; }
  void push(const Candidate& node) override;
  void push_root(std::int32_t id, Cost cost, std::int32_t conflicts) override { push({id, cost, 0, cost, conflicts}); }
  std::int32_t pop() override;
  bool popped_for_its_bound() const override { return true; }

 private:
  struct Entry {
    Candidate node;
    std::int64_t number;
    bool operator<(const Entry& other) const;
  };

  Limits& limits_;
  std::vector<Entry> open_;  // a heap
  std::int64_t number_ = 0;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf
