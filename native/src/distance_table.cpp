#include "mrpbench_mapf/distance_table.hpp"

#include <algorithm>
#include <functional>
#include <map>

namespace mrpbench::mapf {

DistanceTable::DistanceTable(const Roadmap& roadmap, int profile, std::span<const int> goals, Limits& limits)
    : roadmap_(roadmap), limits_(limits), duration_(roadmap.duration(profile)) {
  limits.charge(static_cast<std::size_t>(roadmap.vertex_count()) * (sizeof(Tick) + sizeof(Entry)));
  for (const Tick duration : duration_) {
    if (duration < 0) continue;
    shortest_ = std::min(shortest_, duration);
    longest_ = std::max(longest_, duration);
  }
  distance_.assign(roadmap.vertex_count(), kForever);
  for (const int goal : goals) {
    if (distance_[goal] == 0) continue;
    distance_[goal] = 0;
    queue_.push_back({0, goal});
  }
}

void DistanceTable::advance() {
  limits_.check();
  const bool heap = shortest_ != longest_;
  if (next_ == queue_.size()) {
    final_ = kForever;
    return;
  }
  if (heap) std::ranges::pop_heap(queue_, std::greater{});
  const Entry entry = heap ? queue_.back() : queue_[next_++];
  if (heap) queue_.pop_back();
  if (entry.distance > distance_[entry.vertex]) return;
  for (const int edge : roadmap_.in(entry.vertex)) {
    if (duration_[edge] < 0) continue;
    const int vertex = roadmap_.tail(edge);
    const Tick distance = entry.distance + duration_[edge];
    if (distance >= distance_[vertex] || distance >= kForever / 2) continue;
    distance_[vertex] = distance;
    queue_.push_back({distance, vertex});
    if (heap) std::ranges::push_heap(queue_, std::greater{});
  }
  // What was found on the way is at least one edge farther than `entry`, and nothing nearer can still turn up.
  final_ = std::min(kForever, entry.distance + shortest_);
}

DistanceTables::DistanceTables(const Instance& instance, Limits& limits) {
  std::map<std::pair<int, std::vector<int>>, int> known;
  for (const Robot& robot : instance.robots()) {
    std::vector<int> goals = robot.goals;
    std::ranges::sort(goals);
    const auto [place, is_new] = known.try_emplace({robot.profile, goals}, static_cast<int>(tables_.size()));
    if (is_new) {
      limits.check_clock();
      tables_.push_back(std::make_unique<DistanceTable>(instance.roadmap(), robot.profile, robot.goals, limits));
    }
    of_robot_.push_back(place->second);
  }
}

Cost DistanceTables::sum_of_costs(const Instance& instance) {
  Cost sum = 0;
  for (int robot = 0; robot < instance.size(); ++robot) sum += least_cost(instance, robot);
  return sum;
}

Cost DistanceTables::least_cost(const Instance& instance, int robot) {
  const Beginning& beginning = instance.beginning(robot);
  const Tick distance = (*this)[robot](beginning.vertex);
  return distance == 0 ? enter_tick(beginning.occupied.back()) : beginning.free_at + distance;
}

}  // namespace mrpbench::mapf
