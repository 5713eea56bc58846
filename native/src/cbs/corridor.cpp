#include "mrpbench_mapf/cbs/corridor.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

constexpr int kWindow = 2;  // stops before and after the conflict among which a shared lane is sought

}  // namespace

std::optional<std::array<Constraint, 2>> Corridors::resolve(const Situation& situation, const Conflict& conflict,
                                                            bool pseudo) {
  const int one = conflict.one, other = conflict.other;
  list_stops(situation.path(one), one_stops_);
  list_stops(situation.path(other), other_stops_);
  if (!find_lane(conflict)) return std::nullopt;
  extend(situation, conflict, true);
  extend(situation, conflict, false);
  if (chain_.size() == 2 && !pseudo) return std::nullopt;
  const int entrance = chain_.front(), exit = chain_.back();  // of `one`
  if (entrance == exit || !fits(one, entrance) || !fits(other, exit)) return std::nullopt;
  const Tick one_ticks = length(one, true), other_ticks = length(other, false);
  if (one_ticks == kForever || other_ticks == kForever) return std::nullopt;

  // Earliest arrivals at the exits, and by other ways.
  situation.load(one, bench_.table);
  const Tick one_first = bench_.intervals.earliest(bench_.table, bench_.distance_to(one, exit), exit, kForever);
  situation.load(other, bench_.table);
  const Tick other_first =
      bench_.intervals.earliest(bench_.table, bench_.distance_to(other, entrance), entrance, kForever);
  if (one_first == kForever || other_first == kForever) return std::nullopt;
  const Tick one_last = bound(situation, one, chain_[chain_.size() - 2], exit, other_first + one_ticks);
  if (arrival_at(one_stops_, exit) > one_last) return std::nullopt;
  const Tick other_last = bound(situation, other, chain_[1], entrance, one_first + other_ticks);
  if (arrival_at(other_stops_, entrance) > other_last) return std::nullopt;
  return std::array{avoid_vertex(one, exit, 0, one_last), avoid_vertex(other, entrance, 0, other_last)};
}

void Corridors::list_stops(const TimedPath& path, std::vector<Stop>& stops) const {
  stops.clear();
  for (Tick tick = 0; tick <= path.last_tick(); ++tick) {
    if (stops.empty() || stops.back().vertex != path.at[tick]) stops.push_back({path.at[tick], tick});
  }
  for (const Occupation& it : path.occupied) {
    if (it.element < bench_.space.vertex_count()) stops.push_back({it.element, enter_tick(it)});
  }
}

/// Put into `chain_` a lane that both cross near the conflict, in opposite directions.
bool Corridors::find_lane(const Conflict& conflict) {
  const auto present = [&](std::span<const Stop> stops) {
    const auto later = std::ranges::find_if(stops, [&](const Stop& it) { return 2 * it.arrive > conflict.time; });
    return static_cast<int>(later - stops.begin()) - 1;
  };
  const int here = present(one_stops_), there = present(other_stops_);
  const int one_end = std::min<int>(one_stops_.size() - 1, here + kWindow + 1);
  const int other_end = std::min<int>(other_stops_.size() - 1, there + kWindow + 1);
  for (int i = std::max(0, here - kWindow); i < one_end; ++i) {
    for (int j = std::max(0, there - kWindow); j < other_end; ++j) {
      if (one_stops_[i].vertex != other_stops_[j + 1].vertex || one_stops_[i + 1].vertex != other_stops_[j].vertex) {
        continue;
      }
      chain_ = {one_stops_[i].vertex, one_stops_[i + 1].vertex};
      return true;
    }
  }
  return false;
}

/// Lengthen `chain_` while there is only one way on, at most to where one of the robots starts or ends.
void Corridors::extend(const Situation& situation, const Conflict& conflict, bool forwards) {
  if (!forwards) std::ranges::reverse(chain_);
  const auto ends_at = [&](int vertex, int robot) {
    return bench_.space.instance().robots()[robot].start == vertex || situation.path(robot).end() == vertex;
  };
  while (bench_.space.degree(chain_.back()) == 2 && !ends_at(chain_.back(), conflict.one) &&
         !ends_at(chain_.back(), conflict.other)) {
    const int beyond = next(chain_.back(), chain_[chain_.size() - 2]);
    if (beyond == chain_.front()) break;  // a ring
    chain_.push_back(beyond);
  }
  if (!forwards) std::ranges::reverse(chain_);
}

/// Must `robot`, if it comes out at the other end of the chain, have entered at `entrance`?
bool Corridors::fits(int robot, int entrance) const {
  const Beginning& beginning = bench_.space.instance().beginning(robot);
  if (beginning.occupied.size() > 1) return false;
  return beginning.vertex == entrance || std::ranges::find(chain_, beginning.vertex) == chain_.end();
}

int Corridors::next(int vertex, int from) const {
  const Roadmap& roadmap = bench_.space.instance().roadmap();
  for (const int edge : roadmap.out(vertex)) {
    if (roadmap.head(edge) != from) return roadmap.head(edge);
  }
  for (const int edge : roadmap.in(vertex)) {
    if (roadmap.tail(edge) != from) return roadmap.tail(edge);
  }
  return from;
}

/// Ticks that `robot` needs for the chain, kForever if it cannot pass.
Tick Corridors::length(int robot, bool forwards) const {
  Tick sum = 0;
  for (std::size_t k = 0; k + 1 < chain_.size(); ++k) {
    const int tail = forwards ? chain_[k] : chain_[k + 1], head = forwards ? chain_[k + 1] : chain_[k];
    Tick least = kForever;
    for (const Move& move : bench_.space.moves(robot, tail)) {
      if (move.head == head) least = std::min(least, move.duration);
    }
    if (least == kForever) return kForever;
    sum += least;
  }
  return sum;
}

/// Last tick at which `robot` can be at `exit` only by way of the chain, at most `latest`.
Tick Corridors::bound(const Situation& situation, int robot, int before_exit, int exit, Tick latest) {
  situation.load(robot, bench_.table);
  for (const Move& move : bench_.space.moves(robot, before_exit)) {
    if (move.head != exit) continue;
    bench_.table.add({robot, bench_.space.vertex_count() + move.edge, {0, kForever}});
  }
  const Tick round = bench_.intervals.earliest(bench_.table, bench_.distance_to(robot, exit), exit, latest);
  return std::min(round - 1, latest);
}

Tick Corridors::arrival_at(std::span<const Stop> stops, int vertex) const {
  const auto place = std::ranges::find(stops, vertex, &Stop::vertex);
  return place == stops.end() ? kForever : place->arrive;
}

}  // namespace mrpbench::mapf
