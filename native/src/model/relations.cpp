#include "mrpbench_mapf/model/relations.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

constexpr double kAlways = -1.0;

void sort_and_unite(std::vector<Near>& row) {
  std::ranges::sort(row, {}, &Near::element);
  std::size_t kept = 0;
  for (const Near& near : row) {
    if (kept > 0 && row[kept - 1].element == near.element) {
      row[kept - 1].distance = std::min(row[kept - 1].distance, near.distance);
      row[kept - 1].same_lane |= near.same_lane;
    } else {
      row[kept++] = near;
    }
  }
  row.resize(kept);
}

}  // namespace

Relations::Relations(const Instance& instance, Limits& limits)
    : local_(!instance.footprints() && !instance.rules().following_forbidden) {
  const Roadmap& roadmap = instance.roadmap();
  const Exclusions& exclusions = instance.exclusions();
  const int vertices = roadmap.vertex_count();
  limits.charge((static_cast<std::size_t>(roadmap.element_count()) * 2 + exclusions.element.size()) * sizeof(Near));
  first_.reserve(static_cast<std::size_t>(roadmap.element_count()) + 1);
  first_.push_back(0);
  std::vector<Near> row;
  for (int element = 0; element < roadmap.element_count(); ++element) {
    limits.check();
    row.clear();
    if (element < vertices) {
      row.push_back({element, false, kAlways});
    } else {
      add_lane_rules(instance, element - vertices, row);
    }
    if (instance.footprints()) {
      for (auto k = exclusions.first[element]; k < exclusions.first[element + 1]; ++k) {
        row.push_back({exclusions.element[k], false, exclusions.distance[k]});
      }
    }
    sort_and_unite(row);
    place_.push_back(row.empty() ? element : std::min(element, row.front().element));
    near_.insert(near_.end(), row.begin(), row.end());
    first_.push_back(near_.size());
  }
}

void Relations::add_lane_rules(const Instance& instance, int edge, std::vector<Near>& row) const {
  const Roadmap& roadmap = instance.roadmap();
  const bool following = instance.rules().following_forbidden;
  const int tail = roadmap.tail(edge), head = roadmap.head(edge), edges = roadmap.vertex_count();
  for (const int other : roadmap.out(head)) {
    if (following || roadmap.head(other) == tail) row.push_back({edges + other, false, kAlways});
  }
  for (const int other : roadmap.out(tail)) {
    if (roadmap.head(other) != head) continue;
    row.push_back({edges + other, true, following ? kAlways : std::numeric_limits<double>::infinity()});
  }
  if (!following) return;
  for (const int other : roadmap.in(tail)) row.push_back({edges + other, false, kAlways});
}

Relation Relations::find(int one, int other, double reach) const {
  const std::span<const Near> near = row(one);
  if (near.size() <= 8) {
    for (const Near& entry : near) {
      if (entry.element == other) return entry.relation(reach);
    }
    return Relation::none;
  }
  const auto place = std::ranges::lower_bound(near, other, {}, &Near::element);
  return place == near.end() || place->element != other ? Relation::none : place->relation(reach);
}

}  // namespace mrpbench::mapf
