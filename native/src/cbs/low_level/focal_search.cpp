#include "mrpbench_mapf/cbs/low_level/focal_search.hpp"

#include <algorithm>

namespace mrpbench::mapf {

FocalSearch::FocalSearch(const Space& space, SafeIntervals& intervals, Limits& limits, Statistics& statistics,
                         std::size_t patience)
    : space_(space),
      intervals_(intervals),
      limits_(limits),
      statistics_(statistics),
      // In small maps the cost is quickly computed; where moves take many ticks, all searches are long.
      patience_(space.classical() ? std::min<std::size_t>(patience, 4 * space.vertex_count()) : 0),
      vertices_(space.vertex_count()),
      known_(limits) {}

Tick FocalSearch::search(const ConstraintTable& table, DistanceTable& distance, const AvoidanceTable& others,
                         const StateOrder& order, const CostBound& bound, Tick known, FoundPath& path) {
  table_ = &table;
  distance_ = &distance;
  others_ = &others;
  order_ = order;
  bound_ = bound;
  path.goal = table.goal();
  const Beginning& beginning = space_.instance().beginning(table.robot());
  const Tick to_go = distance(beginning.vertex), since = enter_tick(beginning.occupied.back());
  if (to_go == kForever || table.forbids_beginning()) return kForever;
  const Tick soonest = to_go == 0 ? since : beginning.free_at + to_go;
  Tick least = std::max({known, table.earliest_finish(), soonest});
  if (least > table.latest_finish() || least == kForever) return kForever;
  latest_ = std::max(table.latest_finish(), beginning.free_at);
  begin(least);
  bool exact = false, found = false;
  while (!queue_.empty() && !found) {
    limits_.check();
    if (!exact && nodes_.size() > patience_) {
      // States that cost less than the cheapest path are expanded in vain, and there may be no path: find its cost
      // first.
      exact = true;
      const Tick cost = intervals_.least_cost(table, distance);
      if (cost == kForever) return kForever;
      latest_ = std::min(latest_, std::max(bound(cost), beginning.free_at));
      if (cost > least) begin(least = cost);
    }
    if (queue_.least_f() > least) {
      least = queue_.least_f();
      queue_.raise(bound(least));
    }
    const std::int32_t index = queue_.pop();
    const Node node = nodes_[index];
    std::int32_t& fewest = known_(node.vertex, node.tick);
    if (fewest < node.conflicts) continue;  // expanded, or a better way was found
    fewest = kExpanded;
    queue_.close(node.f);
    found = node.vertex >= vertices_;
    if (found) {
      trace(index, path);
    } else {
      expand(index);
    }
  }
  limits_.charge_growth(counted_, nodes_.capacity() * (sizeof(Node) + FocalQueue::kEntryBytes));
  return found ? least : kForever;
}

/// Start from the beginning of the robot; no path costs less than `least`.
void FocalSearch::begin(Tick least) {
  const Beginning& beginning = space_.instance().beginning(table_->robot());
  const Tick since = enter_tick(beginning.occupied.back());
  least_ = least;
  nodes_.clear();
  known_.clear();
  queue_.reset(least, bound_(least));
  reach(beginning.vertex, beginning.free_at, -1, -1, 0);
  const bool there = (*distance_)(beginning.vertex) == 0 && !nodes_.empty();
  if (there && since >= table_->earliest_finish(beginning.vertex)) finish(0, since);
}

void FocalSearch::expand(std::int32_t node) {
  ++statistics_.low_level_expansions;
  const Node from = nodes_[node];
  const ConstraintTable& table = *table_;
  const int robot = table.robot();
  const bool constrained = table.constrains(from.vertex);
  // Once constraints no longer change, waiting costs more and can only avoid conflicts.
  const bool may_wait = from.tick < table.settled() || bound_(from.f) > from.f;
  if (may_wait && !(constrained && table.forbids_waiting(from.vertex, from.tick))) {
    reach(from.vertex, from.tick + 1, node, -1, from.conflicts + others_->waiting(robot, from.vertex, from.tick));
  }
  for (const Move& move : space_.moves(robot, from.vertex)) {
    const Tick arrive = from.tick + move.duration;
    if (constrained && table.forbids_entering(from.vertex, move.edge, from.tick)) continue;
    if (table.forbids(move.head, arrive)) continue;
    reach(move.head, arrive, node, move.edge, from.conflicts + others_->moving(robot, from.vertex, move, from.tick));
  }
}

/// A robot that follows `parent` comes to `vertex` at `tick`.
void FocalSearch::reach(std::int32_t vertex, Tick tick, std::int32_t parent, std::int32_t edge,
                        std::int32_t conflicts) {
  const Tick h = (*distance_)(vertex);
  if (h == kForever) return;
  const Tick f = std::max(tick + h, least_);
  if (f > latest_ || !push({vertex, tick, parent, edge, conflicts, f}, h) || h != 0 || parent < 0) return;
  // A robot that only waits at a goal could have finished before, unless it was too early.
  const Tick earliest = table_->earliest_finish(vertex);
  if (edge >= 0 ? tick >= earliest : tick == earliest) finish(static_cast<std::int32_t>(nodes_.size()) - 1, tick);
}

/// Add the state in which the path to `node` ends.
void FocalSearch::finish(std::int32_t node, Tick cost) {
  const Node& from = nodes_[node];
  const Tick f = std::max(cost, least_);
  // If the bound allows only one cost, all paths have the same conflicts at the goal.
  const bool counts = !space_.instance().rules().disappear_at_goal && bound_(f) > f;
  const int passing = counts ? others_->staying(table_->robot(), from.vertex, from.tick) : 0;
  push({from.vertex + vertices_, from.tick, node, -1, from.conflicts + passing, f}, 0);
}

/// False if the state was reached before with as few conflicts.
bool FocalSearch::push(const Node& node, Tick h) {
  std::int32_t& fewest = known_(node.vertex, node.tick);
  if (fewest <= node.conflicts) return false;
  if (fewest == StateTable::kUnknown) queue_.open(node.f);
  fewest = node.conflicts;
  ++statistics_.low_level_generated;
  nodes_.push_back(node);
  const double rest = (order_.distance_weight - 1.0) * h + order_.conflict_weight * node.conflicts;
  queue_.push(static_cast<std::int32_t>(nodes_.size()) - 1, node.f, order_.conflict_weight > 0.0 ? 0 : node.conflicts,
              node.f - least_ + static_cast<int>(rest));
  return true;
}

void FocalSearch::trace(std::int32_t node, FoundPath& path) {
  stops_.clear();
  for (std::int32_t it = nodes_[node].parent; it >= 0; it = nodes_[it].parent) {
    stops_.push_back({nodes_[it].vertex, nodes_[it].tick, nodes_[it].edge});
  }
  std::ranges::reverse(stops_);
  follow(space_, table_->robot(), stops_, path);
}

}  // namespace mrpbench::mapf
