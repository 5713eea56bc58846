#include "mrpbench_mapf/model/conflict.hpp"

#include <algorithm>

namespace mrpbench::mapf {

void limit(const Instance& instance, std::vector<Occupation>& path) {
  const Half last = 2 * instance.rules().horizon;
  std::erase_if(path, [&](const Occupation& it) { return it.begin > last; });
  if (!path.empty() && path.back().element < instance.roadmap().vertex_count()) {
    path.back().end = std::min(path.back().end, last);
  }
}

PairConflict find_conflict(const Instance& instance, const Relations& relations, int one,
                           std::span<const Occupation> one_path, int other, std::span<const Occupation> other_path) {
  PairConflict found{one, other, 0, 0, 0, Relation::none, 0};
  const double reach = instance.reach(one, other);
  const int vertices = instance.roadmap().vertex_count();
  const bool footprints = instance.footprints();
  const Half last = 2 * instance.rules().horizon;
  std::size_t first = 0;
  for (std::size_t i = 0; i < one_path.size() && one_path[i].begin <= last; ++i) {
    const Occupation& a = one_path[i];
    Range near = widened(a.begin, a.end, instance.rules().k);
    near.last = std::min(near.last, last);
    while (first < other_path.size() && other_path[first].end < near.first) ++first;
    for (std::size_t j = first; j < other_path.size() && other_path[j].begin <= near.last; ++j) {
      const Occupation& b = other_path[j];
      const bool comparable = footprints || (a.element < vertices) == (b.element < vertices);
      const Relation relation = comparable ? relations.between(a.element, b.element, reach) : Relation::none;
      if (relation == Relation::none || (relation == Relation::ordered && !overtakes(a, b))) continue;
      const Half time = std::max(a.begin, b.begin);
      if (found.count++ > 0 && time >= found.time) continue;
      found.one_step = static_cast<std::int32_t>(i);
      found.other_step = static_cast<std::int32_t>(j);
      found.time = time;
      found.relation = relation;
    }
  }
  return found;
}

}  // namespace mrpbench::mapf
