#include "mrpbench_mapf/cbs/reasoning/rectangle.hpp"

#include <algorithm>
#include <numeric>

namespace mrpbench::mapf {

bool Rectangles::resolve(const Mdd& one, const TimedPath& one_path, const Mdd& other, const TimedPath& other_path,
                         int vertex, Tick tick) {
  const Mdds mdds{&one, &other};
  if (one.find(vertex, tick) < 0 || other.find(vertex, tick) < 0) return false;
  if (!find_region(mdds, vertex, tick)) return false;
  propagate();
  relate_exits();
  const int one_exit = exit_of(one_path, vertex, tick), other_exit = exit_of(other_path, vertex, tick);
  std::array<std::vector<std::int32_t>, 2> chosen, alternative;
  if (select(0, one_exit, chosen) < select(1, other_exit, alternative)) chosen.swap(alternative);
  for (int side = 0; side < 2; ++side) {
    if (std::ranges::find(chosen[side], side == 0 ? one_exit : other_exit) == chosen[side].end()) return false;
    branch_[side].clear();
    for (const std::int32_t place : chosen[side]) {
      const auto& [where, when] = std::pair(places_[place].vertex, places_[place].tick);
      branch_[side].push_back(avoid_vertex(mdds[side]->robot(), where, when, when));
    }
  }
  return chosen[0].size() + chosen[1].size() > 2;
}

/// Fill `places_` with what is connected to the conflict. False if that is only the conflict itself.
bool Rectangles::find_region(const Mdds& mdds, int vertex, Tick tick) {
  list_common(mdds, tick);
  group_.resize(places_.size());
  std::iota(group_.begin(), group_.end(), 0);
  const auto root = [&](int place) {
    while (group_[place] != place) place = group_[place] = group_[group_[place]];
    return place;
  };
  for (int side = 0; side < 2; ++side) {
    const int offset = mdds[side]->level_begin(begin_);
    place_of_.assign(mdds[side]->level_end(begin_ + static_cast<Tick>(levels_.size()) - 2) - offset, -1);
    for (std::size_t k = 0; k < places_.size(); ++k) place_of_[places_[k].node[side] - offset] = k;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      for (const Mdd::Arc& arc : mdds[side]->arcs(places_[k].node[side])) {
        const std::size_t index = arc.to - offset;
        if (index < place_of_.size() && place_of_[index] >= 0) group_[root(place_of_[index])] = root(k);
      }
    }
  }
  const int wanted = root(find(vertex, tick));
  std::size_t kept = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (root(k) == wanted) place_of_[kept++] = static_cast<std::int32_t>(k);
  }
  if (kept == 1) return false;
  for (std::size_t k = 0; k < kept; ++k) {
    if (place_of_[k] != static_cast<std::int32_t>(k)) places_[k] = std::move(places_[place_of_[k]]);
  }
  places_.resize(kept);
  begin_ = places_.front().tick;
  levels_.clear();
  for (std::size_t k = 0; k < kept; ++k) {
    while (begin_ + static_cast<Tick>(levels_.size()) <= places_[k].tick)
      levels_.push_back(static_cast<std::int32_t>(k));
  }
  levels_.push_back(static_cast<std::int32_t>(kept));
  connect(mdds, 0);
  connect(mdds, 1);
  return true;
}

/// All places of both diagrams in the unbroken run of ticks around `tick` that have some.
void Rectangles::list_common(const Mdds& mdds, Tick tick) {
  const auto common = [&](Tick at) {
    const std::size_t before = places_.size();
    int one = mdds[0]->level_begin(at), other = mdds[1]->level_begin(at);
    while (one < mdds[0]->level_end(at) && other < mdds[1]->level_end(at)) {
      const int a = mdds[0]->vertex(one), b = mdds[1]->vertex(other);
      if (a == b) places_.push_back({a, at, {one, other}});
      one += a <= b;
      other += b <= a;
    }
    return places_.size() > before;
  };
  const Tick first = std::max(mdds[0]->first_tick(), mdds[1]->first_tick());
  const Tick last = std::min(mdds[0]->last_tick(), mdds[1]->last_tick());
  places_.clear();
  begin_ = tick;
  while (begin_ > first && common(begin_ - 1)) --begin_;
  places_.clear();
  levels_.clear();
  Tick at = begin_;
  do {
    limits_.check();
    levels_.push_back(static_cast<std::int32_t>(places_.size()));
  } while (at <= last && common(at++));
}

/// The ways of one robot between the places, into the region and out of it.
void Rectangles::connect(const Mdds& mdds, int side) {
  const Mdd& mdd = *mdds[side];
  const Tick last = places_.back().tick, before = std::max(begin_ - 1, mdd.first_tick());
  const int offset = mdd.level_begin(before), end = mdd.level_end(last);
  place_of_.assign(end - offset, -1);
  exits_[side].clear();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    place_of_[places_[k].node[side] - offset] = static_cast<std::int32_t>(k);
    places_[k].entrance[side] = places_[k].tick == mdd.first_tick();
    places_[k].exit[side] = mdd.arcs(places_[k].node[side]).empty();
  }
  for (int node = offset; node < end; ++node) {
    const std::int32_t from = place_of_[node - offset];
    for (const Mdd::Arc& arc : mdd.arcs(node)) {
      const std::int32_t to = arc.to < end ? place_of_[arc.to - offset] : -1;
      if (from >= 0 && to >= 0) places_[to].before[side].push_back(from);
      if (from < 0 && to >= 0) places_[to].entrance[side] = true;
      if (from >= 0 && to < 0) places_[from].exit[side] = true;
    }
  }
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (places_[k].exit[side]) exits_[side].push_back(static_cast<std::int32_t>(k));
  }
}

/// Level by level: two places exclude one another if they are one, or if all ways to both do.
void Rectangles::propagate() {
  first_excluded_.clear();
  excluded_.clear();
  for (std::size_t level = 0; level + 1 < levels_.size(); ++level) {
    first_excluded_.push_back(excluded_.size());
    const std::size_t width = levels_[level + 1] - levels_[level];
    limits_.charge_growth(counted_, excluded_.size() + width * width);
    for (int one = levels_[level]; one < levels_[level + 1]; ++one) {
      limits_.check();
      for (int other = levels_[level]; other < levels_[level + 1]; ++other) {
        excluded_.push_back(one == other || must_meet(places_[one], places_[other]));
      }
    }
  }
}

bool Rectangles::must_meet(const Place& one, const Place& other) const {
  if (one.entrance[0] || other.entrance[1]) return false;
  return std::ranges::all_of(one.before[0], [&](int a) {
    return std::ranges::all_of(other.before[1], [&](int b) {
      return excluded(a, b) || (places_[a].vertex == other.vertex && places_[b].vertex == one.vertex);
    });
  });
}

bool Rectangles::excluded(int one, int other) const {
  const std::size_t level = places_[one].tick - begin_;
  const std::size_t width = levels_[level + 1] - levels_[level];
  return excluded_[first_excluded_[level] + (one - levels_[level]) * width + (other - levels_[level])];
}

/// Which exits exclude one another. Where one is left before the other, the meeting must have been before that: all the
/// places through which the later robot may come then exclude the exit of the earlier one.
void Rectangles::relate_exits() {
  const auto exits = static_cast<std::size_t>(exits_[1].size());
  exits_excluded_.assign(exits_[0].size() * exits, false);
  for (int side = 0; side < 2; ++side) {
    for (std::size_t e = 0; e < exits_[side].size(); ++e) {
      limits_.check();
      const int exit = exits_[side][e];
      present_.assign(places_.size(), false);
      std::size_t k = 0;
      while (k < exits_[1 - side].size() && places_[exits_[1 - side][k]].tick < places_[exit].tick) ++k;
      const std::size_t level = places_[exit].tick - begin_;
      for (std::size_t place = levels_[level]; place < places_.size() && k < exits_[1 - side].size(); ++place) {
        const Place& it = places_[place];
        const auto ruled_out = [&](std::int32_t before) { return present_[before] != 0; };
        present_[place] =
            it.tick == places_[exit].tick
                ? (side == 0 ? excluded(exit, static_cast<int>(place)) : excluded(static_cast<int>(place), exit))
                : !it.entrance[1 - side] && std::ranges::all_of(it.before[1 - side], ruled_out);
        if (static_cast<std::size_t>(exits_[1 - side][k]) != place) continue;
        if (present_[place]) exits_excluded_[side == 0 ? e * exits + k : k * exits + e] = true;
        ++k;
      }
    }
  }
}

/// Where a path that is at `vertex` at `tick` leaves the region.
int Rectangles::exit_of(const TimedPath& path, int vertex, Tick tick) const {
  int place = find(vertex, tick);
  for (Tick at = tick + 1; at <= path.last_tick(); ++at) {
    const int next = find(path.at[at], at);
    if (next < 0) break;
    place = next;
  }
  return place;
}

int Rectangles::find(int vertex, Tick tick) const {
  if (tick < begin_ || tick - begin_ + 1 >= static_cast<Tick>(levels_.size())) return -1;
  const auto begin = places_.begin() + levels_[tick - begin_], end = places_.begin() + levels_[tick - begin_ + 1];
  const auto place =
      std::lower_bound(begin, end, vertex, [](const Place& it, int wanted) { return it.vertex < wanted; });
  return place == end || place->vertex != vertex ? -1 : static_cast<int>(place - places_.begin());
}

/// All exits of the other side that exclude `first`, and all on its own side that exclude each of those; their number.
std::size_t Rectangles::select(int side, int first, std::array<std::vector<std::int32_t>, 2>& chosen) const {
  const auto related = [&](std::size_t mine, std::size_t theirs) {
    return exits_excluded_[side == 0 ? mine * exits_[1].size() + theirs : theirs * exits_[1].size() + mine] != 0;
  };
  const std::size_t from = std::ranges::find(exits_[side], first) - exits_[side].begin();
  if (from == exits_[side].size()) return 0;
  std::vector<std::size_t> theirs;
  for (std::size_t k = 0; k < exits_[1 - side].size(); ++k) {
    if (!related(from, k)) continue;
    theirs.push_back(k);
    chosen[1 - side].push_back(exits_[1 - side][k]);
  }
  for (std::size_t k = 0; k < exits_[side].size() && !theirs.empty(); ++k) {
    if (std::ranges::all_of(theirs, [&](std::size_t it) { return related(k, it); })) {
      chosen[side].push_back(exits_[side][k]);
    }
  }
  return chosen[0].size() + chosen[1].size();
}

}  // namespace mrpbench::mapf
