#include "mrpbench_mapf/single_agent/distance_table.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace mrpbench::mapf {

namespace {

/// Bytes of flat tables above which those of an instance are in pages.
constexpr std::size_t kFlatBytes = std::size_t{256} << 20;

/// The least and the greatest duration of an edge; kForever and 0 if there are none.
std::pair<Tick, Tick> range_of(std::span<const Tick> durations) {
  std::pair<Tick, Tick> range{kForever, 0};
  for (const Tick duration : durations) {
    if (duration >= 0) range = {std::min(range.first, duration), std::max(range.second, duration)};
  }
  return range;
}

/// What distances are multiples of, where all edges take equally long.
Tick unit_of(std::pair<Tick, Tick> range) {
  return range.first == range.second ? std::max<Tick>(1, range.first) : 1;
}

/// Give the memory of pages that are gone back to the system: glibc keeps blocks of that size, some GiB of them with
/// 10,000 robots, for allocations that never come.
void return_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

DistanceTable::DistanceTable(const Roadmap& roadmap, int profile, std::span<const int> goals, Limits& limits,
                             DistanceTable* then, bool pages)
    : roadmap_(roadmap),
      limits_(&limits),
      duration_(roadmap.duration(profile)),
      distance_(roadmap.vertex_count(), pages, unit_of(range_of(duration_)), limits) {
  std::tie(shortest_, longest_) = range_of(duration_);
  for (const int goal : goals) {
    const Tick distance = then == nullptr ? 0 : (*then)(goal);
    if (distance_[goal] == distance) continue;  // known, or there is no way on
    distance_.set(goal, distance, limits);
    heap_.push_back({distance, goal});
  }
  const auto as_far = [&](const Entry& it) { return it.distance == heap_.front().distance; };
  uniform_ = shortest_ == longest_ && std::ranges::all_of(heap_, as_far);
  if (uniform_) {
    for (const Entry& it : heap_) level_.push_back(it.vertex);
    heap_.clear();
  } else {
    std::ranges::make_heap(heap_, std::greater{});
  }
}

void DistanceTable::go_on(Limits& limits) {
  limits_ = &limits;
  distance_.charge(limits);
  limits.charge(counted_);
}

void DistanceTable::advance() {
  limits_->check();
  if (uniform_) {
    advance_level();
  } else {
    advance_heap();
  }
}

/// Where all edges take equally long and all goals are as far, vertices are found in the order of their distances.
void DistanceTable::advance_level() {
  if (next_ == level_.size()) {
    std::swap(level_, found_);
    found_.clear();
    next_ = 0;
    limits_->charge_growth(counted_, (level_.capacity() + found_.capacity()) * sizeof(std::int32_t));
  }
  if (level_.empty()) {
    final_ = kForever;
    return;
  }
  const int vertex = level_[next_++];
  const Tick distance = distance_[vertex] + shortest_;
  for (const int edge : roadmap_.in(vertex)) {
    const int tail = roadmap_.tail(edge);
    if (distance >= distance_[tail] || duration_[edge] < 0 || distance >= kForever / 2) continue;
    distance_.set(tail, distance, *limits_);
    found_.push_back(tail);
  }
  final_ = std::min(kForever, distance);
}

void DistanceTable::advance_heap() {
  if (heap_.empty()) {
    final_ = kForever;
    return;
  }
  std::ranges::pop_heap(heap_, std::greater{});
  const Entry entry = heap_.back();
  heap_.pop_back();
  if (entry.distance > distance_[entry.vertex]) return;
  for (const int edge : roadmap_.in(entry.vertex)) {
    if (duration_[edge] < 0) continue;
    const int vertex = roadmap_.tail(edge);
    const Tick distance = entry.distance + duration_[edge];
    if (distance >= distance_[vertex] || distance >= kForever / 2) continue;
    distance_.set(vertex, distance, *limits_);
    heap_.push_back({distance, vertex});
    std::ranges::push_heap(heap_, std::greater{});
  }
  limits_->charge_growth(counted_, heap_.capacity() * sizeof(Entry));
  // Everything found later is at least one edge farther than `entry`, so nothing nearer can follow.
  final_ = std::min(kForever, entry.distance + shortest_);
}

DistanceCache::~DistanceCache() {
  const bool pages = !tables_.empty() && tables_.begin()->second->in_pages();
  tables_.clear();
  if (pages) return_memory();
}

std::unique_ptr<DistanceTable> DistanceCache::take(const Key& key) {
  const std::scoped_lock lock(mutex_);
  auto node = tables_.extract(key);
  return node.empty() ? nullptr : std::move(node.mapped());
}

void DistanceCache::keep(Tables tables) {
  const std::scoped_lock lock(mutex_);
  tables_.swap(tables);
}

DistanceTables::DistanceTables(const Instance& instance, Limits& limits) : cache_(instance.distances()) {
  const Roadmap& roadmap = instance.roadmap();
  const std::size_t flat = static_cast<std::size_t>(roadmap.vertex_count()) * sizeof(Tick);
  const bool pages = flat * static_cast<std::size_t>(instance.size()) > kFlatBytes;
  const auto table = [&](int profile, std::vector<int> goals) {
    std::ranges::sort(goals);
    const auto [place, is_new] = tables_.try_emplace({profile, std::move(goals)});
    if (is_new) {
      limits.check_clock();
      if (cache_) place->second = cache_->take(place->first);
      if (place->second) {
        place->second->go_on(limits);
      } else {
        place->second = std::make_unique<DistanceTable>(roadmap, profile, place->first.second, limits, nullptr, pages);
      }
    }
    return place->second.get();
  };
  std::map<std::tuple<int, std::vector<int>, DistanceTable*>, DistanceTable*> known;
  const auto onward = [&](int profile, std::vector<int> goals, DistanceTable* then) {
    std::ranges::sort(goals);
    const auto [place, is_new] = known.try_emplace({profile, goals, then});
    if (is_new) {
      limits.check_clock();
      onward_.push_back(std::make_unique<DistanceTable>(roadmap, profile, goals, limits, then, pages));
      place->second = onward_.back().get();
    }
    return place->second;
  };
  remaining_.resize(instance.size());
  for (int robot = 0; robot < instance.size(); ++robot) {
    const Robot& it = instance.robots()[robot];
    std::vector<DistanceTable*>& tables = remaining_[robot];
    tables.push_back(table(it.profile, it.goals));
    for (int set = static_cast<int>(it.via.size()); set-- > instance.beginning(robot).visited;) {
      tables.push_back(onward(it.profile, it.via[set], tables.back()));
    }
    std::ranges::reverse(tables);
  }
}

DistanceTables::~DistanceTables() {
  const bool pages = !tables_.empty() && tables_.begin()->second->in_pages();
  if (cache_) {
    cache_->keep(std::move(tables_));
  } else if (pages) {
    tables_.clear();
    return_memory();
  }
}

Cost DistanceTables::sum_of_costs(const Instance& instance) {
  Cost sum = 0;
  for (int robot = 0; robot < instance.size(); ++robot) sum += least_cost(instance, robot);
  return sum;
}

Cost DistanceTables::makespan(const Instance& instance) {
  Cost latest = 0;
  for (int robot = 0; robot < instance.size(); ++robot) latest = std::max(latest, least_cost(instance, robot));
  return latest;
}

Cost DistanceTables::least_cost(const Instance& instance, int robot) {
  const Beginning& beginning = instance.beginning(robot);
  const Tick distance = (*this)[robot](beginning.vertex);
  return distance == 0 ? enter_tick(beginning.occupied.back()) : beginning.free_at + distance;
}

}  // namespace mrpbench::mapf
