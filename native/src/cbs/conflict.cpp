#include "mrpbench_mapf/cbs/conflict.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

/// Textbook: two paths tick by tick.
class Ticks {
 public:
  Ticks(const Space& space, int one, const TimedPath& one_path, int other, const TimedPath& other_path,
        Arena<Constraint>& constraints, std::vector<Conflict>& found)
      : space_(space),
        one_(one),
        other_(other),
        a_(one_path),
        b_(other_path),
        constraints_(constraints),
        found_(found) {}

  void sweep() {
    const Tick both = std::min(a_.last_tick(), b_.last_tick());
    for (Tick tick = 0; tick <= both; ++tick) {
      if (a_.at[tick] == b_.at[tick]) {
        meet(a_.at[tick], tick);
      } else if (tick < both && a_.at[tick] == b_.at[tick + 1] && a_.at[tick + 1] == b_.at[tick]) {
        swap(tick);
      }
    }
    if (!a_.stays) return;
    const TimedPath& longer = a_.last_tick() > both ? a_ : b_;
    const int parked = a_.last_tick() > both ? b_.at.back() : a_.at.back();
    for (Tick tick = both + 1; tick <= longer.last_tick(); ++tick) {
      if (longer.at[tick] == parked) meet(parked, tick);
    }
  }

 private:
  void meet(int vertex, Tick tick) {
    const Constraint first = avoid_vertex(one_, vertex, tick, tick), second = avoid_vertex(other_, vertex, tick, tick);
    found_.push_back(
        {one_, other_, vertex, vertex, 2 * tick, a_.stays && tick >= a_.cost, b_.stays && tick >= b_.cost});
    keep(first, second);
  }
  void swap(Tick tick) {
    const int vertices = space_.vertex_count();
    const int first = vertices + space_.edge(one_, a_.at[tick], a_.at[tick + 1]);
    const int second = vertices + space_.edge(other_, b_.at[tick], b_.at[tick + 1]);
    found_.push_back({one_, other_, first, second, 2 * tick + 1, false, false});
    keep({one_, first, {tick, tick}}, {other_, second, {tick, tick}});
  }
  void keep(const Constraint& first, const Constraint& second) {
    found_.back().branch = {constraints_.copy(std::span(&first, 1)), constraints_.copy(std::span(&second, 1))};
  }

  const Space& space_;
  int one_, other_;
  const TimedPath &a_, &b_;
  Arena<Constraint>& constraints_;
  std::vector<Conflict>& found_;
};

void find_between_occupations(const Space& space, int one, const TimedPath& one_path, int other,
                              const TimedPath& other_path, Arena<Constraint>& constraints,
                              std::vector<Conflict>& found) {
  const double reach = space.instance().reach(one, other);
  const std::span<const Occupation> a = one_path.occupied, b = other_path.occupied;
  const auto stays = [](const TimedPath& path, Half time) {
    return path.occupied.back().end == kForeverHalf && time >= 2 * path.cost;
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const Relation relation = space.relations().between(a[i].element, b[j].element, reach);
    if (relation == Relation::exclusive || (relation == Relation::ordered && overtakes(a[i], b[j]))) {
      const Half time = std::max(a[i].begin, b[j].begin);
      const PairConflict pair{one,      other, static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), time,
                              relation, 1};
      const auto [first, second] = split(pair, a, b, space.vertex_count());
      found.push_back({one, other, a[i].element, b[j].element, time, stays(one_path, time), stays(other_path, time)});
      found.back().branch = {constraints.copy(std::span(&first, 1)), constraints.copy(std::span(&second, 1))};
    }
    const Half a_end = a[i].end, b_end = b[j].end;
    i += a_end <= b_end;
    j += b_end <= a_end;
  }
}

}  // namespace

void find_conflicts(const Space& space, int one, const TimedPath& one_path, int other, const TimedPath& other_path,
                    Arena<Constraint>& constraints, std::vector<Conflict>& found) {
  if (space.textbook()) {
    Ticks(space, one, one_path, other, other_path, constraints, found).sweep();
  } else {
    find_between_occupations(space, one, one_path, other, other_path, constraints, found);
  }
}

bool stands_in_way(const Space& space, int robot, const TimedPath& path, const Constraint& parked) {
  const Tick from = parked.range.first;
  if (space.textbook()) {
    const std::size_t begin = std::min<std::size_t>(from, path.at.size() - 1);
    return std::find(path.at.begin() + begin, path.at.end(), parked.element) != path.at.end() &&
           (path.stays || path.last_tick() >= from);
  }
  const double reach = space.instance().reach(robot, parked.robot);
  return std::ranges::any_of(path.occupied, [&](const Occupation& it) {
    return it.end >= 2 * from && space.relations().between(it.element, parked.element, reach) == Relation::exclusive;
  });
}

}  // namespace mrpbench::mapf
