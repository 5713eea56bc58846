#include "mrpbench_mapf/cbs/low_level/focal_search.hpp"

#include <algorithm>
#include <bit>

namespace mrpbench::mapf {

namespace {
constexpr std::size_t kFewSlots = 1024;
}  // namespace

FocalSearch::FocalSearch(const Space& space, SafeIntervals& intervals, const BoundedOptions& options, Limits& limits,
                         Statistics& statistics, std::size_t patience)
    : space_(space),
      intervals_(intervals),
      options_(options),
      limits_(limits),
      statistics_(statistics),
      patience_(space.classical() ? patience : 0),  // where moves take many ticks, all searches are long
      vertices_(space.vertex_count()) {}

Tick FocalSearch::search(const ConstraintTable& table, DistanceTable& distance, const AvoidanceTable& others,
                         const CostBound& bound, Tick known, FoundPath& path) {
  table_ = &table;
  path.goal = table.goal();
  distance_ = &distance;
  others_ = &others;
  const Beginning& beginning = space_.instance().beginning(table.robot());
  const Tick to_go = distance(beginning.vertex), since = enter_tick(beginning.occupied.back());
  if (to_go == kForever || table.forbids_beginning()) return kForever;
  const Tick soonest = to_go == 0 ? since : beginning.free_at + to_go;
  Tick least = std::max({known, table.earliest_finish(), soonest});
  if (least > table.latest_finish() || least == kForever) return kForever;
  begin(least, bound);
  bool exact = false, found = false;
  while (!queue_.empty() && !found) {
    limits_.check();
    if (!exact && nodes_.size() > patience_) {
      // States that cost less than the cheapest path lead nowhere, and perhaps there is no path: find its cost first.
      exact = true;
      const Tick cost = intervals_.least_cost(table, distance);
      if (cost == kForever) return kForever;
      if (cost > least) begin(least = cost, bound);
    }
    if (queue_.least_f() > least) {
      least = queue_.least_f();
      queue_.raise(bound(least));
    }
    const std::int32_t node = queue_.pop();
    nodes_[node].closed = true;
    found = nodes_[node].vertex >= vertices_;
    if (found) {
      trace(node, path);
    } else {
      expand(node);
    }
  }
  limits_.charge_growth(
      counted_, nodes_.capacity() * (sizeof(Node) + FocalQueue::kNodeBytes) + known_.capacity() * sizeof(std::int32_t));
  return found ? least : kForever;
}

/// With nothing but the beginning; no path costs less than `least`.
void FocalSearch::begin(Tick least, const CostBound& bound) {
  const Beginning& beginning = space_.instance().beginning(table_->robot());
  const Tick since = enter_tick(beginning.occupied.back());
  least_ = least;
  nodes_.clear();
  known_.assign(kFewSlots, 0);
  queue_.reset(least, bound(least));
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
  if (!(constrained && table.forbids_waiting(from.vertex, from.tick))) {
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
  if (f > std::max(table_->latest_finish(), space_.instance().beginning(table_->robot()).free_at)) return;
  relax({vertex, tick, parent, edge, conflicts, false}, f, h);
  if (h != 0 || parent < 0) return;
  // A robot that only waits at a goal could have finished before, unless it was too early.
  const Tick earliest = table_->earliest_finish(vertex);
  if (edge >= 0 ? tick >= earliest : tick == earliest) finish(slot(vertex, tick) - 1, tick);
}

/// Let the path to `node` end there.
void FocalSearch::finish(std::int32_t node, Tick cost) {
  const Node& from = nodes_[node];
  const bool stays = !space_.instance().rules().disappear_at_goal;
  const int passing = stays ? others_->staying(table_->robot(), from.vertex, from.tick) : 0;
  relax({from.vertex + vertices_, from.tick, node, -1, from.conflicts + passing, false}, std::max(cost, least_), 0);
}

void FocalSearch::relax(const Node& node, Tick f, Tick h) {
  const int row = options_.conflict_weight > 0.0 ? 0 : node.conflicts;
  std::int32_t& known = slot(node.vertex, node.tick);
  if (known != 0) {
    Node& old = nodes_[known - 1];
    if (old.closed || old.conflicts <= node.conflicts) return;
    old = node;
    queue_.update(known - 1, row, column(f, h, node.conflicts));
    return;
  }
  ++statistics_.low_level_generated;
  nodes_.push_back(node);
  known = static_cast<std::int32_t>(nodes_.size());
  queue_.push(known - 1, f, row, column(f, h, node.conflicts));
  if (nodes_.size() * 2 > known_.size()) grow();
}

int FocalSearch::column(Tick f, Tick h, std::int32_t conflicts) const {
  const double rest = (options_.distance_weight - 1.0) * h + options_.conflict_weight * conflicts;
  return f - least_ + static_cast<int>(rest);
}

std::int32_t& FocalSearch::slot(std::int32_t vertex, Tick tick) {
  const std::uint64_t key = static_cast<std::uint64_t>(tick) << 32 | static_cast<std::uint32_t>(vertex);
  const int shift = std::countl_zero(known_.size()) + 1;
  std::size_t place = (key * 0x9E3779B97F4A7C15ULL) >> shift;
  while (known_[place] != 0) {
    const Node& node = nodes_[known_[place] - 1];
    if (node.vertex == vertex && node.tick == tick) break;
    place = (place + 1) & (known_.size() - 1);
  }
  return known_[place];
}

void FocalSearch::grow() {
  known_.assign(known_.size() * 4, 0);
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    slot(nodes_[node].vertex, nodes_[node].tick) = static_cast<std::int32_t>(node) + 1;
  }
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
