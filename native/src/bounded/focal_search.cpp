#include "mrpbench_mapf/bounded/focal_search.hpp"

#include <algorithm>
#include <bit>

namespace mrpbench::mapf {

namespace {
constexpr std::size_t kSmallTable = 1024;
constexpr std::size_t kLongSearch = 4096;
}  // namespace

FocalSearch::FocalSearch(const UnitRoadmap& roadmap, const BoundedOptions& options, Limits& limits,
                         Statistics& statistics)
    : roadmap_(roadmap),
      options_(options),
      limits_(limits),
      statistics_(statistics),
      nobody_(roadmap.vertex_count(), 0, limits) {}

Tick FocalSearch::search(int start, int goal, UnitDistance& distance, const UnitConstraints& constraints,
                         const PathTable& others, const CostBound& bound, Tick known,
                         std::vector<std::int32_t>& steps) {
  free_from_ = constraints.free_from(goal);
  latest_ = constraints.latest_arrival();
  least_ = std::max({known, free_from_, distance(start)});
  passing_.assign(others.ticks() + 1, 0);
  for (Tick tick = others.ticks() - 1; tick > 0; --tick) {
    passing_[tick - 1] = passing_[tick];
    others.visitors(goal, tick, [&](int) { ++passing_[tick - 1]; });
  }
  const auto [least, end] = run(start, goal, distance, constraints, others, bound);
  if (least != kForever) trace(end, steps);
  return least;
}

Tick FocalSearch::earliest_visit(int start, int vertex, UnitDistance& distance, const UnitConstraints& constraints) {
  free_from_ = 0;
  latest_ = kForever;
  least_ = distance(start);
  passing_.clear();
  return run(start, vertex, distance, constraints, nobody_, {}).least;
}

FocalSearch::Found FocalSearch::run(int start, int goal, UnitDistance& distance, const UnitConstraints& constraints,
                                    const PathTable& others, const CostBound& bound) {
  if (least_ > latest_ || least_ == kForever || constraints.forbids(start, start, 0)) return {kForever, -1};
  distance_ = &distance;
  constraints_ = &constraints;
  others_ = &others;
  goal_ = goal;
  last_tick_ = std::max(constraints.last_change(), least_) + roadmap_.vertex_count();
  detours_ = false;
  nodes_.clear();
  table_.assign(kSmallTable, 0);
  queue_.reset(least_, bound(least_));
  relax(start, 0, least_, distance(start), -1, 0);
  if (start == goal) arrive(0, -1, 0);

  Tick least = least_;
  Found found{kForever, -1};
  while (!queue_.empty() && found.node < 0) {
    limits_.check();
    if (nodes_.size() > kLongSearch && !detours_ && !constraints.closed().empty()) find_detours();
    if (queue_.least_f() > least) {
      least = queue_.least_f();
      queue_.raise(bound(least));
    }
    const std::int32_t node = queue_.pop();
    nodes_[node].closed = true;
    if (nodes_[node].vertex == roadmap_.vertex_count()) {
      found = {least, node};
    } else {
      expand(node);
    }
  }
  limits_.charge_growth(
      counted_, nodes_.capacity() * (sizeof(Node) + FocalQueue::kNodeBytes) + table_.capacity() * sizeof(std::int32_t));
  return found;
}

/// Let the path that is at the goal at `tick` end there, if that is allowed.
void FocalSearch::arrive(Tick tick, std::int32_t parent, std::int32_t conflicts) {
  if (tick < free_from_) return;
  const auto passing = static_cast<std::size_t>(tick) < passing_.size() ? passing_[tick] : 0;
  relax(roadmap_.vertex_count(), tick, std::max(tick, least_), 0, parent, conflicts + passing);
}

void FocalSearch::expand(std::int32_t node) {
  ++statistics_.low_level_expansions;
  const Node from = nodes_[node];
  const Tick tick = from.tick + 1;
  if (tick > last_tick_) return;
  const auto go = [&](std::int32_t to) {
    const Tick h = estimate(to, tick);
    if (h == kForever || constraints_->forbids(from.vertex, to, tick)) return;
    const Tick f = std::max(tick + h, least_);
    if (f > latest_) return;
    const std::int32_t conflicts = from.conflicts + others_->count(from.vertex, to, from.tick);
    relax(to, tick, f, h, node, conflicts);
    if (to == goal_ && to != from.vertex) arrive(tick, node, conflicts);  // who only waits there arrived before
  };
  go(from.vertex);
  for (const std::int32_t to : roadmap_.successors(from.vertex)) go(to);
}

/// Vertices that are closed for ever may cut the robot off: without this the search would go on to its last tick.
void FocalSearch::find_detours() {
  detours_ = true;
  detour_.assign(roadmap_.vertex_count(), kForever);
  breadth_.assign(1, goal_);
  detour_[goal_] = 0;
  for (const std::int32_t vertex : constraints_->closed()) detour_[vertex] = -1;
  for (std::size_t next = 0; next < breadth_.size(); ++next) {
    const Tick farther = detour_[breadth_[next]] + 1;
    for (const std::int32_t vertex : roadmap_.predecessors(breadth_[next])) {
      if (detour_[vertex] != kForever) continue;
      detour_[vertex] = farther;
      breadth_.push_back(vertex);
    }
  }
  for (const std::int32_t vertex : constraints_->closed()) detour_[vertex] = kForever;
}

int FocalSearch::column(Tick f, Tick h, std::int32_t conflicts) const {
  const double rest = (options_.distance_weight - 1.0) * h + options_.conflict_weight * conflicts;
  return f - least_ + static_cast<int>(rest);
}

void FocalSearch::relax(std::int32_t vertex, Tick tick, Tick f, Tick h, std::int32_t parent, std::int32_t conflicts) {
  const int row = options_.conflict_weight > 0.0 ? 0 : conflicts;
  std::int32_t& known = slot(vertex, tick);
  if (known != 0) {
    Node& node = nodes_[known - 1];
    if (node.closed || node.conflicts <= conflicts) return;
    node.parent = parent;
    node.conflicts = conflicts;
    queue_.update(known - 1, row, column(f, h, conflicts));
    return;
  }
  ++statistics_.low_level_generated;
  nodes_.push_back({vertex, tick, parent, conflicts, false});
  const auto node = static_cast<std::int32_t>(nodes_.size());
  known = node;
  queue_.push(node - 1, f, row, column(f, h, conflicts));
  if (nodes_.size() * 2 > table_.size()) grow();
}

std::int32_t& FocalSearch::slot(std::int32_t vertex, Tick tick) {
  const std::uint64_t key = static_cast<std::uint64_t>(tick) << 32 | static_cast<std::uint32_t>(vertex);
  const int shift = std::countl_zero(table_.size()) + 1;
  std::size_t place = (key * 0x9E3779B97F4A7C15ULL) >> shift;
  while (table_[place] != 0) {
    const Node& node = nodes_[table_[place] - 1];
    if (node.vertex == vertex && node.tick == tick) break;
    place = (place + 1) & (table_.size() - 1);
  }
  return table_[place];
}

void FocalSearch::grow() {
  table_.assign(table_.size() * 4, 0);
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    slot(nodes_[node].vertex, nodes_[node].tick) = static_cast<std::int32_t>(node) + 1;
  }
}

void FocalSearch::trace(std::int32_t node, std::vector<std::int32_t>& steps) const {
  steps.resize(nodes_[node].tick + 1);
  steps.back() = goal_;
  for (std::int32_t it = nodes_[node].parent; it >= 0; it = nodes_[it].parent) {
    steps[nodes_[it].tick] = nodes_[it].vertex;
  }
}

}  // namespace mrpbench::mapf
