#include "mrpbench_mapf/model/conflict.hpp"

#include <algorithm>

namespace mrpbench::mapf {

PairConflict find_conflict(const Instance& instance, const Relations& relations, int one,
                           std::span<const Occupation> one_path, int other, std::span<const Occupation> other_path) {
  PairConflict found{one, other, 0, 0, 0, Relation::none, 0};
  const double reach = instance.reach(one, other);
  const int vertices = instance.roadmap().vertex_count();
  const bool footprints = instance.footprints();
  std::size_t i = 0, j = 0;
  while (i < one_path.size() && j < other_path.size()) {
    const Occupation &a = one_path[i], &b = other_path[j];
    const bool comparable = footprints || (a.element < vertices) == (b.element < vertices);
    const Relation relation = comparable ? relations.between(a.element, b.element, reach) : Relation::none;
    if (relation == Relation::exclusive || (relation == Relation::ordered && overtakes(a, b))) {
      if (found.count++ == 0) {
        found.one_step = static_cast<std::int32_t>(i);
        found.other_step = static_cast<std::int32_t>(j);
        found.time = std::max(a.begin, b.begin);
        found.relation = relation;
      }
    }
    const Half end = std::min(a.end, b.end);
    i += a.end == end;
    j += b.end == end;
  }
  return found;
}

}  // namespace mrpbench::mapf
