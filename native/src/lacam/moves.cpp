#include "lacam/moves.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace mrpbench::mapf::lacam {

namespace {

int profile_of(const Instance& instance) {
  return instance.size() == 0 ? 0 : instance.robots().front().profile;
}

}  // namespace

Moves::Moves(const Instance& instance, Limits& limits) {
  const Roadmap& roadmap = instance.roadmap();
  const std::span<const Tick> duration = roadmap.duration(profile_of(instance));
  const auto vertices = static_cast<std::size_t>(roadmap.vertex_count()), edges = duration.size();
  limits.charge((vertices + 1 + 2 * edges) * sizeof(std::int32_t));
  first_.reserve(vertices + 1);
  head_.reserve(edges);
  edge_.reserve(edges);
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

bool is_plain(const Instance& instance) {
  if (instance.size() == 0) return true;
  const Rules& rules = instance.rules();
  if (instance.footprints() || !instance.resources().empty()) return false;
  if (rules.following_forbidden || rules.disappear_at_goal) return false;
  const int profile = profile_of(instance);
  const auto simple = [&](const Robot& robot) {
    return robot.profile == profile && robot.ready == 0 && robot.committed.empty() && robot.goals.size() == 1;
  };
  if (!std::ranges::all_of(instance.robots(), simple)) return false;
  return std::ranges::none_of(instance.roadmap().duration(profile), [](Tick ticks) { return ticks > 1; });
}

void require_plain(const Instance& instance, const char* solver) {
  if (!is_plain(instance)) throw std::invalid_argument(std::string(solver) + " needs a roadmap of unit moves");
}

}  // namespace mrpbench::mapf::lacam
