#include "mrpbench_mapf/bounded/unit_roadmap.hpp"

#include <algorithm>

namespace mrpbench::mapf {

UnitRoadmap::UnitRoadmap(const Roadmap& roadmap, int profile) {
  const std::span<const Tick> duration = roadmap.duration(profile);
  const auto index = [&](auto edges_of, auto end_of, auto& first, auto& item) {
    first.push_back(0);
    for (int vertex = 0; vertex < roadmap.vertex_count(); ++vertex) {
      const std::size_t begin = item.size();
      for (const int edge : edges_of(vertex)) {
        if (duration[edge] < 0) continue;
        const std::int32_t end = end_of(edge);
        if (std::find(item.begin() + static_cast<std::ptrdiff_t>(begin), item.end(), end) == item.end()) {
          item.push_back(end);  // one of parallel lanes is enough: two robots would meet at their ends
        }
      }
      first.push_back(static_cast<std::int32_t>(item.size()));
    }
  };
  index([&](int v) { return roadmap.out(v); }, [&](int e) { return roadmap.head(e); }, out_first_, head_);
  index([&](int v) { return roadmap.in(v); }, [&](int e) { return roadmap.tail(e); }, in_first_, tail_);
}

std::optional<UnitRoadmap> unit_roadmap(const Instance& instance) {
  const Rules& rules = instance.rules();
  if (instance.footprints() || rules.following_forbidden || rules.disappear_at_goal) return std::nullopt;
  if (instance.size() == 0 || instance.size() > kMostRobots) return std::nullopt;
  const int profile = instance.robots().front().profile;
  for (const Robot& robot : instance.robots()) {
    if (robot.profile != profile || robot.ready > 0 || !robot.committed.empty() || robot.goals.size() != 1) {
      return std::nullopt;
    }
  }
  if (std::ranges::any_of(instance.roadmap().duration(profile), [](Tick ticks) { return ticks > 1; })) {
    return std::nullopt;
  }
  return UnitRoadmap(instance.roadmap(), profile);
}

std::vector<Occupation> occupations(const Instance& instance, int robot, Steps steps) {
  const Roadmap& roadmap = instance.roadmap();
  const std::span<const Tick> duration = roadmap.duration(instance.robots()[robot].profile);
  const auto lane = [&](int tail, int head) {
    const std::span<const int> edges = roadmap.out(tail);
    return *std::ranges::find_if(edges, [&](int edge) { return roadmap.head(edge) == head && duration[edge] > 0; });
  };
  std::vector<Occupation> path{at_vertex(steps[0], 0, 0)};
  for (Tick tick = 0; tick + 1 < static_cast<Tick>(steps.size()); ++tick) {
    path.back().end = 2 * tick;
    if (steps[tick] == steps[tick + 1]) continue;
    path.push_back(on_edge(roadmap.vertex_count() + lane(steps[tick], steps[tick + 1]), tick, tick + 1));
    path.push_back(at_vertex(steps[tick + 1], tick + 1, tick + 1));
  }
  path.back().end = kForeverHalf;
  return path;
}

}  // namespace mrpbench::mapf
