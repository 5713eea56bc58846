#include "mrpbench_mapf/bounded/unit_distance.hpp"

namespace mrpbench::mapf {

UnitDistance::UnitDistance(const UnitRoadmap& roadmap, int goal, Limits& limits, int closed)
    : roadmap_(roadmap), limits_(limits) {
  distance_.assign(roadmap.vertex_count(), kForever);
  queue_.reserve(roadmap.vertex_count());
  if (closed >= 0) distance_[closed] = 0;
  distance_[goal] = 0;
  queue_.push_back(goal);
}

/// Until the distance of `vertex` is known, or all distances are. In the order of the queue the first value is final.
void UnitDistance::search(int vertex) {
  while (next_ < queue_.size() && distance_[vertex] == kForever) {
    limits_.check();
    const std::int32_t from = queue_[next_++];
    const Tick farther = distance_[from] + 1;
    for (const std::int32_t to : roadmap_.predecessors(from)) {
      if (distance_[to] != kForever) continue;
      distance_[to] = farther;
      queue_.push_back(to);
    }
  }
}

}  // namespace mrpbench::mapf
