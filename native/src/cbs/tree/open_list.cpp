#include "mrpbench_mapf/cbs/tree/open_list.hpp"

#include <algorithm>
#include <tuple>

namespace mrpbench::mapf {

/// Tell whether this node is taken out later.
bool BestFirst::Entry::operator<(const Entry& other) const {
  return std::tuple(node.least, node.conflicts, node.heuristic, other.number) >
         std::tuple(other.node.least, other.node.conflicts, other.node.heuristic, number);
}

void BestFirst::push(const Candidate& node) {
  open_.push_back({node, number_++});
  std::push_heap(open_.begin(), open_.end());
  limits_.charge_growth(counted_, open_.capacity() * sizeof(Entry));
}

std::int32_t BestFirst::pop() {
  std::pop_heap(open_.begin(), open_.end());
  const std::int32_t id = open_.back().node.id;
  open_.pop_back();
  return id;
}

}  // namespace mrpbench::mapf
