#include "lacam/moves.hpp"

#include <algorithm>

namespace mrpbench::mapf::lacam {

Moves::Moves(const Roadmap& roadmap, int profile) {
  const std::span<const Tick> duration = roadmap.duration(profile);
  first_.push_back(0);
  for (int vertex = 0; vertex < roadmap.vertex_count(); ++vertex) {
    const auto begin = static_cast<std::ptrdiff_t>(head_.size());
    for (const int edge : roadmap.out(vertex)) {
      const std::int32_t head = roadmap.head(edge);
      // One of parallel lanes is enough: two robots on them would meet at their ends.
      if (duration[edge] < 0 || std::find(head_.begin() + begin, head_.end(), head) != head_.end()) continue;
      head_.push_back(head);
      edge_.push_back(edge);
    }
    first_.push_back(static_cast<std::int32_t>(head_.size()));
  }
}

int Moves::edge(int tail, int head) const {
  std::int32_t k = first_[tail];
  while (head_[k] != head) ++k;
  return edge_[k];
}

std::optional<Moves> unit_moves(const Instance& instance) {
  const Rules& rules = instance.rules();
  if (instance.footprints() || !instance.resources().empty()) return std::nullopt;
  if (rules.following_forbidden || rules.disappear_at_goal) return std::nullopt;
  const int profile = instance.size() == 0 ? 0 : instance.robots().front().profile;
  for (const Robot& robot : instance.robots()) {
    const bool plain =
        robot.profile == profile && robot.ready == 0 && robot.committed.empty() && robot.goals.size() == 1;
    if (!plain) return std::nullopt;
  }
  const auto longer = [](Tick ticks) { return ticks > 1; };
  if (std::ranges::any_of(instance.roadmap().duration(profile), longer)) return std::nullopt;
  return Moves(instance.roadmap(), profile);
}

}  // namespace mrpbench::mapf::lacam
