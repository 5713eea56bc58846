// By how much the cost of a node must still rise, because pairs of robots get in one another's way: every pair with a
// conflict is solved on its own, and the extra costs of the pairs are covered by extra costs of the robots (the WDG
// heuristic of Li, Felner, Boyarski, Ma and Koenig, "Improved heuristics for multi-agent path finding with
// conflict-based search", IJCAI 2019; pairs were first looked at by Felner et al., ICAPS 2018).
#pragma once

#include <unordered_map>

#include "mrpbench_mapf/cbs/tree/constraint_tree.hpp"
#include "mrpbench_mapf/cbs/tree/vertex_cover.hpp"

namespace mrpbench::mapf {

class Dependencies {
 public:
  static constexpr Cost kImpossible = kForever;

  explicit Dependencies(SearchContext& context)
      : context_(context), open_(context.limits), pair_(context, open_, optimal(context.options)) {}

  /// A lower bound on how far the least costs of the robots are below that of any solution, given the conflicts of
  /// their present paths; `kImpossible` if there is no solution.
  Cost evaluate(const NodeState& state, std::span<const Conflict* const> conflicts);
  /// Nodes that were expanded, and conflicts that were bypassed, in the trees for pairs.
  std::int64_t expansions() const { return pair_.counts().expanded + pair_.counts().bypasses; }

 private:
  struct Name {
    std::int32_t one, other;
    Key one_key, other_key;
    bool operator==(const Name&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Name& it) const {
      return mix(it.one_key.low ^ mix(it.other_key.low + static_cast<std::uint64_t>(it.one) * 65537 + it.other));
    }
  };

  // Searches for pairs that come to no end and raise the bound little (of two robots in a wide maze, say) may take so
  // many expansions, and as many more as nodes are evaluated.
  static constexpr std::int64_t kSpareAtFirst = 640;

  /// The same techniques for cheapest paths.
  static CbsOptions optimal(CbsOptions options) {
    options.w = 1.0;
    options.flex = false;
    options.order = {};
    return options;
  }
  std::int32_t least_cost(const NodeState& state, int one, int other);
  std::int32_t solve(const NodeState& state, int one, int other);

  SearchContext& context_;
  BestFirst open_;
  ConstraintTree pair_;
  std::unordered_map<Name, std::int32_t, Hash> known_;
  std::size_t counted_ = 0;
  std::int64_t spare_ = kSpareAtFirst;  // expansions for such searches
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
  std::vector<std::int32_t> number_;  // by robot: its vertex in the graph of dependencies
  std::vector<WeightedEdge> edges_;
};

}  // namespace mrpbench::mapf
