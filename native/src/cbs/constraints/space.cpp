#include "mrpbench_mapf/cbs/constraints/space.hpp"

#include <algorithm>

namespace mrpbench::mapf {

Space::Space(const Instance& instance, Limits& limits) : instance_(instance), classical_(is_classical()) {
  const Roadmap& roadmap = instance.roadmap();
  limits.charge(static_cast<std::size_t>(roadmap.profile_count()) *
                (roadmap.edge_count() * sizeof(Move) + roadmap.vertex_count() * sizeof(std::int32_t)));
  for (int index = 0; index < roadmap.profile_count(); ++index) {
    limits.check_clock();
    profiles_.push_back(profile(index));
  }
  certain_of_.resize(instance.size());
  bool committed = false;
  for (int robot = 0; robot < instance.size(); ++robot) {
    const Beginning& beginning = instance.beginning(robot);
    committed |= beginning.occupied.size() > 1 || beginning.free_at > 0;
  }
  if (committed || !classical_) relations_.emplace(instance, limits);
  if (instance.footprints() && instance.size() > 1) find_junctions(limits);
  if (!committed) return;
  certain_.emplace(instance, *relations_, limits);
  reserve_beginnings(instance, *certain_);
  list_certain();
}

bool Space::is_classical() const {
  const Roadmap& roadmap = instance_.roadmap();
  if (instance_.footprints() || instance_.rules().following_forbidden || !instance_.resources().empty()) return false;
  if (instance_.size() > kMostRobots || instance_.rules().k > 0) return false;
  for (int profile = 0; profile < roadmap.profile_count(); ++profile) {
    if (std::ranges::any_of(roadmap.duration(profile), [](Tick ticks) { return ticks != 1 && ticks != -1; })) {
      return false;
    }
  }
  return std::ranges::all_of(instance_.robots(), [](const Robot& robot) {
    return std::ranges::all_of(robot.committed,
                               [](const Segment& it) { return it.edge < 0 || it.leave == it.enter + 1; });
  });
}

Space::Profile Space::profile(int index) const {
  const Roadmap& roadmap = instance_.roadmap();
  const std::span<const Tick> duration = roadmap.duration(index);
  Profile result;
  result.first.reserve(roadmap.vertex_count() + 1);
  result.moves.reserve(roadmap.edge_count());
  for (int vertex = 0; vertex < roadmap.vertex_count(); ++vertex) {
    const std::size_t begin = result.moves.size();
    result.first.push_back(static_cast<std::int32_t>(begin));
    for (const int edge : roadmap.out(vertex)) {
      const int head = roadmap.head(edge);
      const auto parallel = [&](const Move& move) { return move.head == head; };
      if (duration[edge] < 0) continue;
      if (classical_ && std::any_of(result.moves.begin() + begin, result.moves.end(), parallel)) continue;
      result.moves.push_back({head, edge, lane(head, vertex), duration[edge]});
    }
  }
  result.first.push_back(static_cast<std::int32_t>(result.moves.size()));
  return result;
}

int Space::lane(int tail, int head) const {
  for (const int edge : instance_.roadmap().out(tail)) {
    if (instance_.roadmap().head(edge) == head) return edge;
  }
  return -1;
}

int Space::edge(int robot, int tail, int head) const {
  return std::ranges::find(moves(robot, tail), head, &Move::head)->edge;
}

int Space::degree(int vertex) const {
  return static_cast<int>(instance_.roadmap().neighbours(vertex).size());
}

void Space::find_junctions(Limits& limits) {
  const Roadmap& roadmap = instance_.roadmap();
  std::vector<double> radii;
  for (const Robot& robot : instance_.robots()) radii.push_back(robot.radius);
  std::ranges::sort(radii);
  const double reach = radii[0] + radii[1] - 1e-9;  // of the two that exclude one another least
  limits.charge(static_cast<std::size_t>(vertex_count()));
  junction_.resize(vertex_count());
  std::vector<int> around;
  for (int vertex = 0; vertex < vertex_count(); ++vertex) {
    limits.check();
    around.assign(1, vertex);
    for (const int edge : roadmap.out(vertex)) around.push_back(vertex_count() + edge);
    for (const int edge : roadmap.in(vertex)) around.push_back(vertex_count() + edge);
    junction_[vertex] = true;
    for (std::size_t i = 0; i < around.size() && junction_[vertex]; ++i) {
      junction_[vertex] = std::ranges::all_of(std::span(around).subspan(i), [&](int other) {
        return relations_->between(around[i], other, reach) == Relation::exclusive;
      });
    }
  }
}

void Space::list_certain() {
  const int vertices = vertex_count();
  for (int robot = 0; robot < instance_.size(); ++robot) {
    std::vector<std::int32_t> elements;
    for (int other = 0; other < instance_.size(); ++other) {
      if (other == robot) continue;
      for (const Occupation& occupation : instance_.beginning(other).occupied) {
        for (const Near& near : relations_->row(occupation.element)) elements.push_back(near.element);
        for (const std::int32_t resource : instance_.resources_of(occupation.element)) {
          const std::vector<int>& shared = instance_.resources()[resource].elements;
          elements.insert(elements.end(), shared.begin(), shared.end());
        }
      }
    }
    std::ranges::sort(elements);
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    const std::span<const Tick> duration = instance_.roadmap().duration(instance_.robots()[robot].profile);
    std::vector<Range> ranges;
    for (const std::int32_t element : elements) {
      ranges.clear();
      if (element < vertices) {
        certain_->at_vertex(robot, element, ranges);
      } else if (duration[element - vertices] >= 0) {
        certain_->on_edge(robot, element - vertices, duration[element - vertices], ranges);
      }
      for (const Range& range : ranges) certain_of_[robot].push_back({robot, element, range});
    }
  }
}

}  // namespace mrpbench::mapf
