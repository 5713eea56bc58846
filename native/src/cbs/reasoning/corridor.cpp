#include "mrpbench_mapf/cbs/reasoning/corridor.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

constexpr int kWindow = 2;  // stops before and after the conflict among which a shared lane is sought

}  // namespace

std::optional<std::array<Constraint, 2>> Corridors::resolve(const NodeState& state, const Conflict& conflict,
                                                            bool pseudo) {
  const int one = conflict.one, other = conflict.other;
  list_stops(state.path(one), one_stops_);
  list_stops(state.path(other), other_stops_);
  if (!find_lane(conflict)) return std::nullopt;
  extend([&](int vertex) {
    return std::ranges::any_of(std::array{one, other}, [&](int robot) { return state.path(robot).end() == vertex; });
  });
  if (chain_.size() == 2 && !pseudo) return std::nullopt;
  const int entrance = chain_.front(), exit = chain_.back();  // of `one`
  if (entrance == exit || !opposed(one, other)) return std::nullopt;
  const Tick one_ticks = length(one, 0, chain_.size() - 1), other_ticks = length(other, chain_.size() - 1, 0);
  if (one_ticks == kForever || other_ticks == kForever) return std::nullopt;

  // Earliest arrivals at the exits, and by other ways.
  const Tick one_first = earliest(state, one, exit, kForever);
  const Tick other_first = earliest(state, other, entrance, kForever);
  if (one_first == kForever || other_first == kForever) return std::nullopt;
  const Tick one_last = bound(state, one, chain_[chain_.size() - 2], exit, other_first + one_ticks);
  if (arrival_at(one_stops_, exit) > one_last) return std::nullopt;
  const Tick other_last = bound(state, other, chain_[1], entrance, one_first + other_ticks);
  if (arrival_at(other_stops_, entrance) > other_last) return std::nullopt;
  return std::array{avoid_vertex(one, exit, 0, one_last), avoid_vertex(other, entrance, 0, other_last)};
}

std::optional<Corridors::AtTarget> Corridors::resolve_at_target(const NodeState& state, const Conflict& conflict,
                                                                int passing, int ending) {
  const Instance& instance = context_.space.instance();
  const int target = state.path(ending).end();
  const auto is_end = [&](int vertex) {
    return instance.robots()[passing].start == vertex || state.path(passing).end() == vertex;
  };
  if (instance.rules().disappear_at_goal || context_.space.degree(target) != 2 || is_end(target)) return std::nullopt;
  if (is_under_way(passing) || is_under_way(ending)) return std::nullopt;
  list_stops(state.path(passing), one_stops_);
  if (!find_passage(conflict, target)) return std::nullopt;
  extend(is_end);
  const int entrance = chain_.front(), exit = chain_.back();
  if (entrance == exit) return std::nullopt;
  const std::size_t inside = std::ranges::find(chain_, target) - chain_.begin(), last = chain_.size() - 1;

  // A robot that goes through the chain lets no other robot stay inside. If `passing` comes out at the exit, before it
  // could by any other way, then `ending` is at its end only after that, and comes there from the exit, once `passing`
  // was there; or from the entrance, behind it.
  const Tick first = earliest(state, passing, exit, kForever);
  const Tick back = length(ending, last, inside), on = length(ending, 0, inside);
  if (first == kForever || back == kForever) return std::nullopt;
  Tick until = first + back;
  if (on < until) {
    const Tick before =
        std::max(earliest(state, ending, entrance, until - on) - 1, earliest(state, passing, entrance, until - on));
    until = std::min(until, std::min(before, until) + on);
  }
  if (state.path(ending).cost > until) return std::nullopt;
  const Tick round = bound(state, passing, chain_[last - 1], exit, kForever);
  if (arrival_at(one_stops_, exit) > round) return std::nullopt;
  using Kind = Constraint::Kind;
  return AtTarget{
      {ending, target, {until, until}, Kind::length_above},
      {Constraint{ending, target, {until, until}, Kind::length_at_most}, avoid_vertex(passing, exit, 0, round)}};
}

void Corridors::list_stops(const TimedPath& path, std::vector<Stop>& stops) const {
  stops.clear();
  for (Tick tick = 0; tick <= path.last_tick(); ++tick) {
    if (stops.empty() || stops.back().vertex != path.at[tick]) stops.push_back({path.at[tick], tick});
  }
  for (const Occupation& it : path.occupied) {
    if (it.element < context_.space.vertex_count()) stops.push_back({it.element, enter_tick(it)});
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

/// Put into `chain_` how the robot of `one_stops_` goes through `target`, nearest to the conflict.
bool Corridors::find_passage(const Conflict& conflict, int target) {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k + 1 < one_stops_.size(); ++k) {
    if (one_stops_[k].vertex != target || one_stops_[k - 1].vertex == one_stops_[k + 1].vertex) continue;
    const auto far = [&](std::size_t it) { return std::abs(2 * one_stops_[it].arrive - conflict.time); };
    if (nearest == 0 || far(k) < far(nearest)) nearest = k;
  }
  if (nearest == 0) return false;
  chain_ = {one_stops_[nearest - 1].vertex, target, one_stops_[nearest + 1].vertex};
  return true;
}

/// Lengthen `chain_` both ways while there is only one way on, at most to where `is_end`.
template <class IsEnd>
void Corridors::extend(IsEnd is_end) {
  for (int side = 0; side < 2; ++side) {
    while (context_.space.degree(chain_.back()) == 2 && !is_end(chain_.back())) {
      const int beyond = next(chain_.back(), chain_[chain_.size() - 2]);
      if (beyond == chain_.front()) break;  // a ring
      chain_.push_back(beyond);
    }
    std::ranges::reverse(chain_);
  }
}

/// Tell whether `robot` begins with committed moves, which may end at or lead through any vertex.
bool Corridors::is_under_way(int robot) const {
  return context_.space.instance().beginning(robot).occupied.size() > 1;
}

/// Tell whether they begin in the chain, or enter it, so that `one` reaches its exit only past `other`.
bool Corridors::opposed(int one, int other) const {
  const auto place = [&](int robot, std::size_t outside) {
    const auto at = std::ranges::find(chain_, context_.space.instance().beginning(robot).vertex);
    return at == chain_.end() ? outside : static_cast<std::size_t>(at - chain_.begin());
  };
  return !is_under_way(one) && !is_under_way(other) && place(one, 0) < place(other, chain_.size() - 1);
}

int Corridors::next(int vertex, int from) const {
  const Roadmap& roadmap = context_.space.instance().roadmap();
  for (const int edge : roadmap.out(vertex)) {
    if (roadmap.head(edge) != from) return roadmap.head(edge);
  }
  for (const int edge : roadmap.in(vertex)) {
    if (roadmap.tail(edge) != from) return roadmap.tail(edge);
  }
  return from;
}

/// Ticks that `robot` needs from one place in the chain to another, kForever if it cannot go there.
Tick Corridors::length(int robot, std::size_t from, std::size_t to) const {
  Tick sum = 0;
  while (from != to) {
    const int tail = chain_[from], head = chain_[from < to ? ++from : --from];
    Tick least = kForever;
    for (const Move& move : context_.space.moves(robot, tail)) {
      if (move.head == head) least = std::min(least, move.duration);
    }
    if (least == kForever) return kForever;
    sum += least;
  }
  return sum;
}

/// The earliest tick at which `robot` can be at `vertex`, kForever if it cannot by tick `latest`.
Tick Corridors::earliest(const NodeState& state, int robot, int vertex, Tick latest) {
  state.load(robot, context_.table);
  return context_.intervals.earliest(context_.table, context_.distance_to(robot, vertex), vertex, latest);
}

/// Last tick at which `robot` can be at `exit` only by way of the chain, at most `latest`.
Tick Corridors::bound(const NodeState& state, int robot, int before_exit, int exit, Tick latest) {
  state.load(robot, context_.table);
  for (const Move& move : context_.space.moves(robot, before_exit)) {
    if (move.head != exit) continue;
    context_.table.add({robot, context_.space.vertex_count() + move.edge, {0, kForever}});
  }
  const Tick round = context_.intervals.earliest(context_.table, context_.distance_to(robot, exit), exit, latest);
  return round == kForever ? latest : std::min(round - 1, latest);
}

Tick Corridors::arrival_at(std::span<const Stop> stops, int vertex) const {
  const auto place = std::ranges::find(stops, vertex, &Stop::vertex);
  return place == stops.end() ? kForever : place->arrive;
}

}  // namespace mrpbench::mapf
