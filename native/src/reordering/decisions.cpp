#include "reordering/decisions.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace mrpbench::mapf {

namespace {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::int32_t find(std::int32_t item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }
  void join(std::int32_t one, std::int32_t other) {
    one = find(one), other = find(other);
    parent_[std::max(one, other)] = std::min(one, other);
  }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace

Decisions::Decisions(const AlternativeGraph& graph) : planned_(graph.alternatives.size()) {
  std::vector<std::int32_t> robot(graph.events());
  for (int r = 0; r < graph.robots(); ++r) {
    std::fill(robot.begin() + graph.first[r], robot.begin() + graph.first[r + 1], r);
  }
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<Pair>> by_robots;
  for (std::size_t k = 0; k < graph.alternatives.size(); ++k) {
    const auto& it = graph.alternatives[k];
    const std::int32_t before = robot[it.planned.before], after = robot[it.planned.after];
    const bool lower_first = before < after;
    planned_[k].side = lower_first ? 0 : 1;
    by_robots[std::minmax(before, after)].push_back(
        {static_cast<std::int32_t>(k),
         {lower_first ? it.planned : it.switched, lower_first ? it.switched : it.planned}});
  }
  std::vector<std::array<std::int32_t, 2>> implications;  // (a, b): side 0 of a needs side 0 of b
  for (const auto& [_, pairs] : by_robots) group(pairs, implications);

  const std::size_t choices = 2 * static_cast<std::size_t>(count_);
  std::vector<std::vector<Arc>> arcs(choices);
  for (std::size_t k = 0; k < graph.alternatives.size(); ++k) {
    arcs[planned_[k].index()].push_back(graph.alternatives[k].planned);
    arcs[planned_[k].other().index()].push_back(graph.alternatives[k].switched);
  }
  std::vector<std::vector<std::int32_t>> implied(choices);
  for (const auto& [a, b] : implications) {
    implied[2 * a].push_back(b);
    implied[2 * b + 1].push_back(a);
  }
  for (std::size_t k = 0; k < choices; ++k) {
    std::ranges::stable_sort(arcs[k], {}, &Arc::after);  // what delays a robot first delays it most
    arc_begin_.push_back(static_cast<std::int32_t>(arcs_.size()));
    arcs_.insert(arcs_.end(), arcs[k].begin(), arcs[k].end());
    std::ranges::sort(implied[k]);
    const auto repeated = std::ranges::unique(implied[k]);
    implied_begin_.push_back(static_cast<std::int32_t>(implied_.size()));
    implied_.insert(implied_.end(), implied[k].begin(), repeated.begin());
  }
  arc_begin_.push_back(static_cast<std::int32_t>(arcs_.size()));
  implied_begin_.push_back(static_cast<std::int32_t>(implied_.size()));
}

std::vector<Side> Decisions::planned_sides() const {
  std::vector<Side> sides(count_);
  for (const Choice& planned : planned_) sides[planned.decision] = planned.side;
  return sides;
}

/// Side 0 of p with side 1 of q is a cycle if the first robot comes from q's arc to p's, and the second from p's to
/// q's.
void Decisions::group(std::span<const Pair> pairs, std::vector<std::array<std::int32_t, 2>>& implications) {
  const auto needs = [](const Pair& p, const Pair& q) {
    return q.arc[1].after <= p.arc[0].before && p.arc[0].after <= q.arc[1].before;
  };
  DisjointSets sets(pairs.size());
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    for (std::size_t q = 0; q < p; ++q) {
      if (needs(pairs[p], pairs[q]) && needs(pairs[q], pairs[p])) {
        sets.join(static_cast<std::int32_t>(p), static_cast<std::int32_t>(q));
      }
    }
  }
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto root = static_cast<std::size_t>(sets.find(static_cast<std::int32_t>(p)));
    planned_[pairs[p].index].decision = root == p ? count_++ : planned_[pairs[root].index].decision;
  }
  for (const Pair& p : pairs) {
    for (const Pair& q : pairs) {
      const std::int32_t a = planned_[p.index].decision, b = planned_[q.index].decision;
      if (a != b && needs(p, q) && (implications.empty() || implications.back() != std::array{a, b})) {
        implications.push_back({a, b});
      }
    }
  }
}

}  // namespace mrpbench::mapf
