#include "lacam/moves.hpp"

#include <algorithm>
#include <map>

namespace mrpbench::mapf::lacam {

Moves::Moves(const Instance& instance, Limits& limits) : vertex_count_(instance.roadmap().vertex_count()) {
  std::map<int, int> known;  // row by profile
  for (const Robot& robot : instance.robots()) {
    const auto [place, is_new] = known.try_emplace(robot.profile, static_cast<int>(rows_.size()));
    if (is_new) gather(instance.roadmap(), robot.profile, limits);
    rows_of_.push_back(place->second);
  }
}

void Moves::gather(const Roadmap& roadmap, int profile, Limits& limits) {
  const std::span<const Tick> duration = roadmap.duration(profile);
  const auto vertices = static_cast<std::size_t>(vertex_count_), edges = duration.size();
  limits.charge((vertices + 1 + 2 * edges) * sizeof(std::int32_t));
  Rows& rows = rows_.emplace_back();
  rows.first.reserve(vertices + 1);
  rows.head.reserve(edges);
  rows.edge.reserve(edges);
  rows.first.push_back(0);
  for (int vertex = 0; vertex < vertex_count_; ++vertex) {
    const auto begin = static_cast<std::ptrdiff_t>(rows.head.size());
    for (const int edge : roadmap.out(vertex)) {
      if (duration[edge] < 0) continue;
      const std::int32_t head = roadmap.head(edge);
      const auto parallel = std::find(rows.head.begin() + begin, rows.head.end(), head);
      if (parallel == rows.head.end()) {
        rows.head.push_back(head);
        rows.edge.push_back(edge);
        continue;
      }
      // One of parallel lanes is enough: two robots on them would meet at their ends.
      std::int32_t& known = rows.edge[parallel - rows.head.begin()];
      if (duration[edge] < duration[known]) known = edge;
    }
    rows.first.push_back(static_cast<std::int32_t>(rows.head.size()));
  }
}

int Moves::most_successors() const {
  std::int32_t most = 0;
  for (const Rows& rows : rows_) {
    for (int vertex = 0; vertex < vertex_count_; ++vertex) {
      most = std::max(most, rows.first[vertex + 1] - rows.first[vertex]);
    }
  }
  return most;
}

int Moves::edge(int robot, int tail, int head) const {
  const Rows& rows = rows_[rows_of_[robot]];
  std::int32_t k = rows.first[tail];
  while (rows.head[k] != head) ++k;
  return rows.edge[k];
}

}  // namespace mrpbench::mapf::lacam
