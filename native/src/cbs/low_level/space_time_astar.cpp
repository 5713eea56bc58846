#include "mrpbench_mapf/cbs/low_level/space_time_astar.hpp"

#include <algorithm>

namespace mrpbench::mapf {

SpaceTimeAstar::SpaceTimeAstar(const Space& space, SafeIntervals& intervals, Limits& limits, Statistics& statistics,
                               std::size_t patience)
    : space_(space),
      intervals_(intervals),
      roadmap_(space.instance().roadmap()),
      limits_(limits),
      statistics_(statistics),
      patience_(patience) {
  forget_seen(kSmallSeen);
}

bool SpaceTimeAstar::search(const ConstraintTable& table, DistanceTable& distance, const AvoidanceTable* others,
                            FoundPath& path) {
  path.goal = table.goal();
  Tick least = table.earliest_finish(), latest = table.latest_finish();
  if (least == kForever) return false;
  if (!space_.classical()) {
    // Where moves take many ticks, most states lead nowhere: expand only those that lead to the least cost.
    least = latest = intervals_.least_cost(table, distance);
    if (least == kForever) return false;
  }
  if (!begin(table, distance, others, least, latest)) return false;
  int last = run(space_.classical() ? patience_ : kWholeSearch);
  if (last == kLong) {
    // Perhaps there is no path at all, which would take even longer to find out.
    const Tick cost = intervals_.least_cost(table, distance);
    if (cost == kForever) return false;
    latest_ = std::max(cost, space_.instance().beginning(table.robot()).free_at);
    last = run(kWholeSearch);
  }
  if (last < 0) return false;
  trace(last, path);
  return path.cost <= table.latest_finish();
}

bool SpaceTimeAstar::is_final(const Node& node) {
  if ((*distance_)(node.vertex) != 0) return false;
  const Beginning& beginning = space_.instance().beginning(table_->robot());
  const bool moved = node.tick > beginning.free_at;
  return (moved ? node.tick : enter_tick(beginning.occupied.back())) >= table_->earliest_finish(node.vertex);
}

bool SpaceTimeAstar::begin(const ConstraintTable& table, DistanceTable& distance, const AvoidanceTable* others,
                           Tick least, Tick latest) {
  const Beginning& beginning = space_.instance().beginning(table.robot());
  const Tick h = distance(beginning.vertex);
  if (h == kForever || table.forbids_beginning()) return false;
  table_ = &table;
  distance_ = &distance;
  others_ = others;
  least_ = std::max(least, beginning.free_at + h);
  latest_ = std::max(latest, beginning.free_at);  // a robot that never moves has finished before it could
  // Among ways of one cost, the first to be expanded need not be the earliest.
  merged_from_ = space_.classical() ? table.settled() : kForever;
  nodes_.clear();
  open_.clear();
  forget_seen(kSmallSeen);
  push(beginning.vertex, beginning.free_at, -1, -1, 0, h);
  return true;
}

/// Expand best first; the index of the node at the end, kNone, or kLong if that makes more than `most_nodes`.
int SpaceTimeAstar::run(std::size_t most_nodes) {
  int found = kNone;
  while (!open_.empty() && found < 0) {
    if (nodes_.size() > most_nodes) return kLong;
    limits_.check();
    const std::int32_t index = open_.pop();
    const Node& node = nodes_[index];
    Seen& known = seen(node.vertex, node.tick < merged_from_ ? node.tick : -1);
    if (known.conflicts < node.conflicts) continue;  // expanded, or a better way was found
    known.conflicts = -1;
    if (is_final(node)) {
      found = index;
    } else {
      expand(index);
    }
  }
  limits_.charge_growth(counted_, nodes_.capacity() * (sizeof(Node) + 2 * sizeof(std::int32_t)));
  return found;
}

void SpaceTimeAstar::expand(int index) {
  ++statistics_.low_level_expansions;
  const Node node = nodes_[index];
  const ConstraintTable& table = *table_;
  const int robot = table.robot();
  const bool constrained = table.constrains(node.vertex);
  const int waiting = others_ == nullptr ? 0 : others_->waiting(robot, node.vertex, node.tick);
  if (node.tick < merged_from_ && !(constrained && table.forbids_waiting(node.vertex, node.tick))) {
    push(node.vertex, node.tick + 1, index, -1, node.conflicts + waiting, (*distance_)(node.vertex));
  }
  for (const Move& move : space_.moves(robot, node.vertex)) {
    const Tick h = (*distance_)(move.head);
    if (h == kForever || (constrained && table.forbids_entering(node.vertex, move.edge, node.tick)) ||
        table.forbids(move.head, node.tick + move.duration)) {
      continue;
    }
    const int moving = others_ == nullptr ? 0 : others_->moving(robot, node.vertex, move, node.tick);
    push(move.head, node.tick + move.duration, index, move.edge, node.conflicts + moving, h);
  }
}

void SpaceTimeAstar::push(int vertex, Tick tick, int parent, int edge, int conflicts, Tick h) {
  const Tick f = std::max(tick + h, least_);
  if (f > latest_) return;
  const bool settled = tick >= merged_from_;
  Seen& known = seen(vertex, settled ? -1 : tick);
  // Once nothing changes, an earlier arrival beats fewer conflicts: only what was expanded is known to be earliest.
  if (settled ? known.conflicts < 0 : known.conflicts <= conflicts) return;
  known.conflicts = settled ? kUnknown : conflicts;
  ++statistics_.low_level_generated;
  nodes_.push_back({vertex, tick, parent, edge, conflicts});
  open_.push(f - least_, conflicts, static_cast<std::int32_t>(nodes_.size()) - 1);
}

SpaceTimeAstar::Seen& SpaceTimeAstar::seen(int vertex, Tick tick) {
  if (2 * seen_count_ > seen_mask_) grow_seen();
  const std::uint32_t mixed =
      static_cast<std::uint32_t>(vertex) * 0x9E3779B1u + static_cast<std::uint32_t>(tick) * 0x85EBCA77u;
  std::size_t slot = (mixed ^ mixed >> 15) & seen_mask_;
  while (seen_[slot].epoch == epoch_ && (seen_[slot].vertex != vertex || seen_[slot].tick != tick)) {
    slot = (slot + 1) & seen_mask_;
  }
  if (seen_[slot].epoch != epoch_) {
    ++seen_count_;
    seen_[slot] = {epoch_, vertex, tick, kUnknown};
  }
  return seen_[slot];
}

/// Use the first `size` slots, which are all free.
void SpaceTimeAstar::forget_seen(std::size_t size) {
  if (size > seen_.size()) {
    limits_.charge((size - seen_.size()) * sizeof(Seen));
    seen_.resize(size);
  }
  if (++epoch_ == 0) {
    std::ranges::fill(seen_, Seen{});
    epoch_ = 1;
  }
  seen_mask_ = size - 1;
  seen_count_ = 0;
}

void SpaceTimeAstar::grow_seen() {
  std::vector<Seen> old;
  std::copy_if(seen_.begin(), seen_.begin() + seen_mask_ + 1, std::back_inserter(old),
               [&](const Seen& it) { return it.epoch == epoch_; });
  forget_seen(4 * (seen_mask_ + 1));
  for (const Seen& it : old) seen(it.vertex, it.tick).conflicts = it.conflicts;
}

void SpaceTimeAstar::trace(int index, FoundPath& path) {
  stops_.clear();
  for (int node = index; node >= 0; node = nodes_[node].parent) {
    stops_.push_back({nodes_[node].vertex, nodes_[node].tick, nodes_[node].edge});
  }
  std::ranges::reverse(stops_);
  follow(space_, table_->robot(), stops_, path);
}

}  // namespace mrpbench::mapf
