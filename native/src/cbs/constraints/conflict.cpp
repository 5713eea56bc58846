#include "mrpbench_mapf/cbs/constraints/conflict.hpp"

#include <algorithm>

namespace mrpbench::mapf {

namespace {

using Pair = std::array<Constraint, 2>;

/// Keep `conflict`, to be resolved by either of `branch`.
void keep(Conflict conflict, const Pair& branch, Arena<Constraint>& constraints, std::vector<Conflict>& found) {
  const std::span<const Constraint> kept = constraints.copy(branch);
  conflict.branch = {kept.first(1), kept.last(1)};
  found.push_back(conflict);
}

/// Classical instances: one path, tick by tick.
class Ticks {
 public:
  Ticks(const Space& space, const PathTable& present, int robot, const TimedPath& path, Arena<Constraint>& constraints,
        std::vector<Conflict>& found)
      : space_(space), present_(present), robot_(robot), path_(path), constraints_(constraints), found_(found) {}

  void sweep() {
    for (Tick tick = 0; tick <= path_.last_tick(); ++tick) {
      const int vertex = path_.at[tick];
      present_.visitors(vertex, tick, [&](int other) { meet(other, vertex, tick); });
      present_.parked(vertex, tick, [&](int other) { meet(other, vertex, tick); });
      if (tick == path_.last_tick() || path_.at[tick + 1] == vertex) continue;
      present_.swappers(vertex, path_.at[tick + 1], tick, [&](int other) { swap(other, tick); });
    }
    if (!path_.stays) return;
    const int goal = path_.at.back();
    for (Tick tick = path_.last_tick() + 1; tick < present_.ticks() && present_.is_visited(goal); ++tick) {
      present_.visitors(goal, tick, [&](int other) { meet(other, goal, tick); });
    }
  }

 private:
  void meet(int other, int vertex, Tick tick) {
    if (other == robot_) return;
    keep({robot_, other, vertex, vertex, 2 * tick, stays(path_, tick), stays(present_.path(other), tick)},
         {avoid_vertex(robot_, vertex, tick, tick), avoid_vertex(other, vertex, tick, tick)}, constraints_, found_);
  }
  void swap(int other, Tick tick) {
    if (other == robot_) return;
    const int from = path_.at[tick], to = path_.at[tick + 1], vertices = space_.vertex_count();
    const int here = vertices + space_.edge(robot_, from, to), there = vertices + space_.edge(other, to, from);
    keep({robot_, other, here, there, 2 * tick + 1, false, false},
         {Constraint{robot_, here, {tick, tick}}, Constraint{other, there, {tick, tick}}}, constraints_, found_);
  }
  static bool stays(const TimedPath& path, Tick tick) { return path.stays && tick >= path.cost; }

  const Space& space_;
  const PathTable& present_;
  int robot_;
  const TimedPath& path_;
  Arena<Constraint>& constraints_;
  std::vector<Conflict>& found_;
};

/// Tell whether a robot that uses something at the half-ticks `own` uses it forever, from before another robot leaves
/// it.
bool stays(const TimedPath& path, const Range& own, const Range& beside) {
  return own.last == kForeverHalf && 2 * path.cost <= beside.last;
}

/// The half-tick at which the constraints on two robots that use the same thing at the same time apply: the last of the
/// overlap, so that the robot that stays behind comes only after the other has left, however long that takes. If
/// neither leaves, it is the first. Any half-tick of the overlap would be right.
Half instant_of(const Range& one, const Range& other) {
  const Half end = std::min(one.last, other.last);
  return end < kForeverHalf ? end : std::max(one.first, other.first);
}

/// All steps of a path, one after another, by which the robot is on the junction at `vertex`.
Range time_on(const Space& space, int vertex, std::span<const Occupation> path, std::size_t step) {
  std::size_t first = step, last = step;
  while (first > 0 && space.meets(path[first - 1].element, vertex)) --first;
  while (last + 1 < path.size() && space.meets(path[last + 1].element, vertex)) ++last;
  return {path[first].begin, path[last].end};
}

/// Conflicts of two robots, neither of which may be where the other is.
class Occupations {
 public:
  Occupations(const Space& space, const AvoidanceTable& present, int robot, const TimedPath& path,
              Arena<Constraint>& constraints, std::vector<Conflict>& found)
      : space_(space),
        present_(present),
        robot_(robot),
        path_(path),
        constraints_(constraints),
        found_(found),
        k_(space.instance().rules().k) {}

  void sweep() {
    for (std::size_t step = 0; step < path_.occupied.size(); ++step) {
      present_.reservations().conflicts_of(robot_, path_.occupied[step], [&](const auto& entry, Relation relation) {
        const TimedPath& other = present_.path(entry.robot);
        const Half time = std::max(path_.occupied[step].begin, entry.begin);
        const PairConflict pair{robot_, entry.robot, static_cast<std::int32_t>(step), entry.step, time, relation, 1};
        if (!meet_at_junctions(pair, other)) {
          const Occupation &here = path_.occupied[step], &there = other.occupied[entry.step];
          meet(pair, other, {here.begin, here.end}, {there.begin, there.end},
               split(pair, path_.occupied, other.occupied, space_.vertex_count(), k_));
        }
      });
    }
  }

 private:
  /// Two robots that are on one junction at the same time have one conflict there, found when they first meet. Each
  /// branch forbids one of them the whole junction in the same window, an instant unless robots may be late. False if
  /// they are not on one junction.
  ///   Complete: a plan that breaks both constraints has both robots on the junction within that window, on two
  ///   elements that exclude each other, or on one element, which excludes itself. Progress: both present paths are on
  ///   the junction within it, so each branch forbids the path of its robot. Nothing is missed: from the instant at
  ///   which the second is on the junction, they are on elements that exclude each other, so that this conflict is
  ///   found.
  bool meet_at_junctions(const PairConflict& pair, const TimedPath& other) {
    const std::int32_t here = path_.occupied[pair.one_step].element, there = other.occupied[pair.other_step].element;
    bool met = false;
    for (const int vertex : space_.ends(here)) {
      if (vertex < 0 || !space_.is_junction(vertex) || !space_.meets(there, vertex)) continue;
      met = true;
      const Range one = time_on(space_, vertex, path_.occupied, pair.one_step);
      const Range two = time_on(space_, vertex, other.occupied, pair.other_step);
      if (pair.time > std::max(one.first, two.first)) continue;  // found when they met there
      const Range window = window_from(instant_of(one, two), k_);
      meet(pair, other, one, two,
           {junction_constraint(pair.one, vertex, window), junction_constraint(pair.other, vertex, window)});
    }
    return met;
  }
  void meet(const PairConflict& pair, const TimedPath& other, const Range& one_time, const Range& other_time,
            const Pair& branch) {
    keep({pair.one, pair.other, path_.occupied[pair.one_step].element, other.occupied[pair.other_step].element,
          pair.time, stays(path_, one_time, other_time), stays(other, other_time, one_time)},
         branch, constraints_, found_);
  }

  const Space& space_;
  const AvoidanceTable& present_;
  int robot_;
  const TimedPath& path_;
  Arena<Constraint>& constraints_;
  std::vector<Conflict>& found_;
  Tick k_;
};

/// Two robots use a resource, which holds one robot, at the same time. Each branch forbids one of them the resource at
/// the same instant of that time. To forbid it at an instant is to forbid all its elements from the setup before the
/// instant until the instant.
///   Complete: a plan that breaks both constraints has both robots use the resource at that instant, against rule 6 of
///   `mrpbench_core.model.planning.conflicts`.
///   Progress: both present paths use it at that instant, so each branch forbids the path of its robot.
/// A resource with room for several robots would need as many branches as the robots that conflict.
void find_in_resources(const Space& space, const AvoidanceTable& present, int robot, const TimedPath& path,
                       Arena<Constraint>& constraints, std::vector<Conflict>& found) {
  for (const Use& use : uses(space.instance(), path.occupied)) {
    present.reservations().users().beside(robot, use, [&](int other, const Range& theirs) {
      const Half instant = instant_of(use.halves, theirs);
      const auto resource_constraint = [&](int it) {
        return Constraint{it, use.resource, {instant, instant}, Constraint::Kind::resource};
      };
      keep({robot, other, -1, -1, std::max(use.halves.first, theirs.first), stays(path, use.halves, theirs),
            stays(present.path(other), theirs, use.halves), use.resource},
           {resource_constraint(robot), resource_constraint(other)}, constraints, found);
    });
  }
}

}  // namespace

void find_conflicts(const Space& space, const AvoidanceTable& present, int robot, const TimedPath& path,
                    Arena<Constraint>& constraints, std::vector<Conflict>& found) {
  if (space.classical()) {
    Ticks(space, present.ticks(), robot, path, constraints, found).sweep();
  } else {
    Occupations(space, present, robot, path, constraints, found).sweep();
    find_in_resources(space, present, robot, path, constraints, found);
  }
}

bool breaks(const Space& space, int robot, const TimedPath& path, std::span<const Constraint> constraints) {
  return std::ranges::any_of(constraints, [&](const Constraint& it) {
    if (it.kind == Constraint::Kind::length_at_most) return it.robot != robot && stands_in_way(space, robot, path, it);
    return it.robot == robot;
  });
}

bool stands_in_way(const Space& space, int robot, const TimedPath& path, const Constraint& parked) {
  const Tick from = parked.range.first;
  if (space.classical()) {
    const std::size_t begin = std::min<std::size_t>(from, path.at.size() - 1);
    return std::find(path.at.begin() + begin, path.at.end(), parked.element) != path.at.end() &&
           (path.stays || path.last_tick() >= from);
  }
  const auto resources = space.instance().resources_of(parked.element);
  const bool shared = std::ranges::any_of(uses(space.instance(), path.occupied), [&](const Use& it) {
    return it.halves.last >= 2 * from && std::ranges::find(resources, it.resource) != resources.end();
  });
  const double reach = space.instance().reach(robot, parked.robot);
  return shared || std::ranges::any_of(path.occupied, [&](const Occupation& it) {
           return widened(it.begin, it.end, space.instance().rules().k).last >= 2 * from &&
                  space.relations().between(it.element, parked.element, reach) == Relation::exclusive;
         });
}

}  // namespace mrpbench::mapf
