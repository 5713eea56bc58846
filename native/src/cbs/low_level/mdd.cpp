#include "mrpbench_mapf/cbs/low_level/mdd.hpp"

#include <algorithm>

namespace mrpbench::mapf {

Mdd MddBuilder::build(const ConstraintTable& table, DistanceTable& distance, Tick cost) {
  const Beginning& beginning = space_.instance().beginning(table.robot());
  first_ = beginning.free_at;
  last_ = std::max(cost, first_);
  reach(table, distance, beginning.vertex);
  prune(table, cost);
  Mdd mdd;
  mdd.robot_ = table.robot();
  mdd.cost_ = cost;
  mdd.first_tick_ = first_;
  mdd.stays_ = !space_.instance().rules().disappear_at_goal;
  number(mdd);
  return mdd;
}

/// Everything that can be reached in time, level by level.
void MddBuilder::reach(const ConstraintTable& table, DistanceTable& distance, int start) {
  const std::size_t count = last_ - first_ + 1;
  limits_.charge_growth(counted_, count * (sizeof(levels_[0]) + 4 * sizeof(std::int32_t)));
  if (levels_.size() < count) levels_.resize(count);
  for (std::size_t k = 0; k < count; ++k) levels_[k].clear();
  level_first_.clear();
  way_first_.assign(1, 0);
  ways_.clear();
  levels_[0].push_back(start);
  for (Tick tick = first_; tick <= last_; ++tick) {
    std::vector<std::int32_t>& level = levels_[tick - first_];
    std::ranges::sort(level);
    level.erase(std::unique(level.begin(), level.end()), level.end());
    level_first_.push_back(static_cast<std::int32_t>(way_first_.size()) - 1);
    for (const std::int32_t vertex : level) {
      limits_.check();
      leave(table, distance, vertex, tick);
      way_first_.push_back(static_cast<std::int32_t>(ways_.size()));
    }
    limits_.charge_growth(counted_, ways_.capacity() * (sizeof(Way) + sizeof(std::int32_t)) +
                                        way_first_.capacity() * 2 * sizeof(std::int32_t));
  }
}

void MddBuilder::leave(const ConstraintTable& table, DistanceTable& distance, int vertex, Tick tick) {
  const auto enter = [&](int head, int edge, Tick arrive) {
    if (distance(head) > last_ - arrive) return;
    levels_[arrive - first_].push_back(head);
    ways_.push_back({head, edge, arrive});
  };
  const bool constrained = table.constrains(vertex);
  if (!(constrained && table.forbids_waiting(vertex, tick))) enter(vertex, -1, tick + 1);
  for (const Move& move : space_.moves(table.robot(), vertex)) {
    const Tick arrive = tick + move.duration;
    if (constrained && table.forbids_entering(vertex, move.edge, tick)) continue;
    if (!table.forbids(move.head, arrive)) enter(move.head, move.edge, arrive);
  }
}

/// Number what leads to a goal at the end.
void MddBuilder::prune(const ConstraintTable& table, Tick cost) {
  const int count = static_cast<int>(way_first_.size()) - 1;
  number_.assign(count, -1);
  for (int node = count - 1, tick = last_; tick >= first_; --tick) {
    const std::vector<std::int32_t>& level = levels_[tick - first_];
    for (auto vertex = level.rbegin(); vertex != level.rend(); ++vertex, --node) {
      const auto leads_on = [&](const Way& way) { return number_[find(way.vertex, way.tick)] >= 0; };
      const bool alive =
          tick == last_ ? table.earliest_finish(*vertex) <= cost : std::ranges::any_of(ways(node), leads_on);
      if (alive) number_[node] = 0;
    }
  }
  std::int32_t next = 0;
  for (std::int32_t& number : number_) {
    if (number >= 0) number = next++;
  }
}

void MddBuilder::number(Mdd& mdd) const {
  for (int node = 0, tick = first_; tick <= last_; ++tick) {
    mdd.level_first_.push_back(static_cast<std::int32_t>(mdd.vertex_.size()));
    for (const std::int32_t vertex : levels_[tick - first_]) {
      if (number_[node] >= 0) {
        mdd.vertex_.push_back(vertex);
        mdd.tick_.push_back(tick);
        mdd.arc_first_.push_back(static_cast<std::int32_t>(mdd.arcs_.size()));
        for (const Way& way : ways(node)) {
          const std::int32_t to = number_[find(way.vertex, way.tick)];
          if (to >= 0) mdd.arcs_.push_back({to, way.edge});
        }
      }
      ++node;
    }
  }
  mdd.level_first_.push_back(static_cast<std::int32_t>(mdd.vertex_.size()));
  mdd.arc_first_.push_back(static_cast<std::int32_t>(mdd.arcs_.size()));
}

int MddBuilder::find(int vertex, Tick tick) const {
  const std::vector<std::int32_t>& level = levels_[tick - first_];
  return level_first_[tick - first_] + static_cast<int>(std::ranges::lower_bound(level, vertex) - level.begin());
}

int Mdd::find(int vertex, Tick tick) const {
  if (tick < first_tick() || tick > last_tick()) return -1;
  const auto begin = vertex_.begin() + level_begin(tick), end = vertex_.begin() + level_end(tick);
  const auto place = std::lower_bound(begin, end, vertex);
  return place == end || *place != vertex ? -1 : static_cast<int>(place - vertex_.begin());
}

bool Mdd::always_at(int vertex, Tick tick) const {
  if (tick > last_tick()) {
    if (!stays_) return false;
    tick = last_tick();
  }
  return tick >= first_tick() && width(tick) == 1 && vertex_[level_begin(tick)] == vertex;
}

bool Mdd::blocked_by(std::span<const Constraint> constraints, ConstraintTable& scratch) const {
  scratch.reset(robot_);
  scratch.add(constraints);
  if (scratch.forbids_beginning() || scratch.latest_finish() < cost_) return true;
  std::vector<char> reached(node_count(), false);
  if (node_count() == 0) return true;
  reached[0] = true;
  for (int node = 0; node < node_count(); ++node) {
    if (!reached[node]) continue;
    if (tick_[node] == last_tick() && scratch.earliest_finish(vertex_[node]) <= cost_) return false;
    const bool constrained = scratch.constrains(vertex_[node]);
    for (const Arc& arc : arcs(node)) {
      if (reached[arc.to]) continue;
      if (constrained && (arc.edge < 0 ? scratch.forbids_waiting(vertex_[node], tick_[node])
                                       : scratch.forbids_entering(vertex_[node], arc.edge, tick_[node]))) {
        continue;
      }
      if (!scratch.forbids(vertex_[arc.to], tick_[arc.to])) reached[arc.to] = true;
    }
  }
  return true;
}

std::size_t Mdd::bytes() const {
  return sizeof(Mdd) + (level_first_.capacity() + vertex_.capacity() + tick_.capacity() + arc_first_.capacity()) * 4 +
         arcs_.capacity() * sizeof(Arc);
}

}  // namespace mrpbench::mapf
