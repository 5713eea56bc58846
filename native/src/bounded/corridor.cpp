#include "mrpbench_mapf/bounded/corridor.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

constexpr std::size_t kMostBytes = 64 << 20;  // of distance tables that are kept

/// The tick from `tick` on, in steps of `direction`, at which a path leaves `chain` by one of its ends: at which end
/// (true: the back), or nothing if the path ends or turns in between.
struct Exit {
  bool at_back;
  Tick tick;
};

std::optional<Exit> find_exit(Steps path, std::span<const std::int32_t> chain, Tick tick, int direction) {
  for (; tick >= 0 && tick < static_cast<Tick>(path.size()); tick += direction) {
    if (path[tick] == chain.back()) return Exit{true, tick};
    if (path[tick] == chain.front()) return Exit{false, tick};
  }
  return std::nullopt;
}

}  // namespace

UnitCorridors::UnitCorridors(const UnitRoadmap& roadmap, FocalSearch& search, Limits& limits)
    : roadmap_(roadmap), search_(search), limits_(limits), inside_(roadmap.vertex_count()) {
  for (int vertex = 0; vertex < roadmap.vertex_count(); ++vertex) {
    const auto out = roadmap.successors(vertex), in = roadmap.predecessors(vertex);
    inside_[vertex] = out.size() == 2 && std::ranges::is_permutation(out, in);
  }
}

/// Extend a chain of at least two vertices at its back as far as the corridor goes; false if it comes round.
bool UnitCorridors::follow(std::vector<std::int32_t>& chain, const std::array<int, 4>& stops) const {
  const std::int32_t origin = chain.front();
  while (inside_[chain.back()] && std::ranges::find(stops, chain.back()) == stops.end()) {
    const auto next = roadmap_.successors(chain.back());
    chain.push_back(next[0] == chain[chain.size() - 2] ? next[1] : next[0]);
    if (chain.back() == origin) return false;
  }
  return true;
}

std::optional<UnitCorridors::Meeting> UnitCorridors::find(const UnitConflict& conflict, const PathTable& table,
                                                          const std::array<int, 4>& stops) const {
  const auto usable = [&](std::int32_t vertex) {
    return vertex >= 0 && inside_[vertex] && std::ranges::find(stops, vertex) == stops.end();
  };
  const std::int32_t middle = usable(conflict.vertex) ? conflict.vertex : conflict.from;
  if (!usable(middle)) return std::nullopt;
  const auto sides = roadmap_.successors(middle);
  std::vector<std::int32_t> back{middle, sides[0]}, front{middle, sides[1]};
  if (!follow(back, stops) || !follow(front, stops)) return std::nullopt;
  std::ranges::reverse(front);
  front.insert(front.end(), back.begin() + 1, back.end());
  if (front.front() == front.back()) return std::nullopt;

  const auto crossing = [&](int robot) -> std::optional<Exit> {  // the far end, if the robot crosses the corridor
    const auto from = find_exit(table.path(robot), front, conflict.time - (conflict.from >= 0), -1);
    const auto to = find_exit(table.path(robot), front, conflict.time, 1);
    return from && to && from->at_back != to->at_back ? to : std::nullopt;
  };
  const auto one = crossing(conflict.one), other = crossing(conflict.other);
  if (!one || !other || one->at_back == other->at_back) return std::nullopt;
  if (!one->at_back) std::ranges::reverse(front);
  return Meeting{conflict.one, conflict.other, std::move(front), one->tick, other->tick};
}

UnitDistance& UnitCorridors::distance_to(int vertex, int closed) {
  const Key key = static_cast<Key>(vertex) * (roadmap_.vertex_count() + 1) + closed + 1;
  const auto place = distances_.find(key);
  if (place != distances_.end()) return place->second;
  const std::size_t bytes = (distances_.size() + 1) * UnitDistance::bytes(roadmap_);
  if (bytes > kMostBytes) distances_.clear();
  limits_.charge_growth(counted_, std::min(bytes, kMostBytes));
  return distances_.try_emplace(key, roadmap_, vertex, limits_, closed).first->second;
}

UnitCorridors::Passage UnitCorridors::passage(std::span<const std::int32_t> chain, int start,
                                              UnitConstraints& constraints) {
  const std::int32_t end = chain.back(), gate = chain[chain.size() - 2];
  Passage result;
  result.through = search_.earliest_visit(start, end, distance_to(end, -1), constraints);
  constraints.forbid_vertex(gate, {0, kForever});
  result.around = search_.earliest_visit(start, end, distance_to(end, gate), constraints);
  return result;
}

std::optional<std::array<UnitConstraint, 2>> UnitCorridors::split(const Meeting& meeting, const Passage& one,
                                                                  const Passage& other) {
  const auto length = static_cast<Tick>(meeting.chain.size()) - 1;
  const auto last = [&](const Passage& own, const Passage& opposite) {
    return std::min(own.around - 1, std::min(opposite.through, kLatestTime) + length);
  };
  const Tick one_last = last(one, other), other_last = last(other, one);
  if (meeting.one_leaves > one_last || meeting.other_leaves > other_last) return std::nullopt;
  const auto stay_off = [](int robot, std::int32_t vertex, Tick until) {
    return UnitConstraint{UnitConstraint::vertex, robot, -1, vertex, {0, until}};
  };
  return std::array{stay_off(meeting.one, meeting.chain.back(), one_last),
                    stay_off(meeting.other, meeting.chain.front(), other_last)};
}

}  // namespace mrpbench::mapf
