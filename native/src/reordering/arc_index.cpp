#include "reordering/arc_index.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

/// Indices of `arcs` sorted by `event_of(arc)`, and where those of each event begin.
template <class Key>
void sort_by_event(const std::vector<Arc>& arcs, int events, Key event_of, std::vector<std::int32_t>& sorted,
                   std::vector<std::int32_t>& begin) {
  begin.assign(events + 1, 0);
  sorted.resize(arcs.size());
  for (const Arc& arc : arcs) ++begin[event_of(arc) + 1];
  for (int event = 0; event < events; ++event) begin[event + 1] += begin[event];
  std::vector<std::int32_t> next = begin;
  for (std::size_t k = 0; k < arcs.size(); ++k) sorted[next[event_of(arcs[k])]++] = static_cast<std::int32_t>(k);
}

}  // namespace

ArcIndex::ArcIndex(const AlternativeGraph& graph, const Decisions& decisions) {
  for (int decision = 0; decision < decisions.count(); ++decision) {
    for (const Side side : {Side{0}, Side{1}}) {
      begin_.push_back(size());
      const auto arcs = decisions.arcs({decision, side});
      arcs_.insert(arcs_.end(), arcs.begin(), arcs.end());
      decision_of_.resize(arcs_.size(), decision);
    }
  }
  begin_.push_back(size());
  arcs_.insert(arcs_.end(), graph.fixed.begin(), graph.fixed.end());
  sort_by_event(arcs_, graph.events(), [](const Arc& arc) { return arc.before; }, out_, out_begin_);
  sort_by_event(arcs_, graph.events(), [](const Arc& arc) { return arc.after; }, in_, in_begin_);
}

std::vector<char> ArcIndex::fixed() const {
  std::vector<char> found(arcs_.size());
  std::fill(found.begin() + first_fixed(), found.end(), 1);
  return found;
}

std::vector<char> ArcIndex::holding(std::span<const Side> sides) const {
  std::vector<char> found = fixed();
  for (std::int32_t arc = 0; arc < first_fixed(); ++arc) {
    const Choice choice = choice_of(arc);
    found[arc] = sides[choice.decision] == choice.side;
  }
  return found;
}

}  // namespace mrpbench::mapf
