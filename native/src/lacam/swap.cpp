#include "lacam/swap.hpp"

namespace mrpbench::mapf::lacam {

Swap::Swap(const Instance& instance, const Moves& moves, DistanceTables& tables) : moves_(moves) {
  for (int robot = 0; robot < instance.size(); ++robot) {
    distance_.push_back(&tables[robot]);
    goal_.push_back(instance.robots()[robot].goals.front());
  }
}

int Swap::partner(int robot, int here, int wanted, std::span<const std::int32_t> now, const std::int32_t* to) {
  now_ = now;
  if (wanted == here) return -1;
  const std::int32_t ahead = now_[wanted];
  if (ahead >= 0 && to[ahead] < 0 && must_swap(robot, ahead, here, wanted) && can_swap(robot, wanted, here)) {
    return ahead;
  }
  // A robot behind this one may have to pass this vertex while this one drives into a dead end.
  for (const std::int32_t vertex : moves_.successors(robot, here)) {
    const std::int32_t behind = now_[vertex];
    if (behind < 0 || vertex == wanted) continue;
    if (must_swap(behind, robot, here, wanted) && can_swap(robot, wanted, here)) return behind;
  }
  return -1;
}

/// The way on of `robot` from `here` when coming from `before`, past dead ends in which a robot is parked; or that
/// there are none or several.
std::int32_t Swap::only_way(int robot, int before, int here) const {
  std::int32_t way = kNone;
  for (const std::int32_t vertex : moves_.successors(robot, here)) {
    if (vertex == before) continue;
    const std::int32_t there = now_[vertex];
    if (there >= 0 && goal_[there] == vertex && moves_.successors(robot, vertex).size() == 1) continue;
    if (way != kNone) return kSeveral;
    way = vertex;
  }
  return way;
}

/// Tell whether the pusher would push the puller along a passage without a place to let it pass, until one robot is on
/// the wrong side of the other.
bool Swap::must_swap(int pusher, int puller, int pusher_at, int puller_at) {
  DistanceTable& to_go = *distance_[pusher];
  while (to_go(puller_at) < to_go(pusher_at)) {
    const std::int32_t way = only_way(puller, pusher_at, puller_at);
    if (way == kSeveral) return false;
    if (way == kNone) break;
    pusher_at = puller_at;
    puller_at = way;
  }
  DistanceTable& other = *distance_[puller];
  return other(pusher_at) < other(puller_at) && (to_go(pusher_at) == 0 || to_go(puller_at) < to_go(pusher_at));
}

/// Tell whether `robot`, which backs away from `pusher_at`, gets from `puller_at` to a vertex where it can step aside.
bool Swap::can_swap(int robot, int pusher_at, int puller_at) const {
  const int begin = pusher_at;
  for (int steps = 0; puller_at != begin && steps < moves_.vertex_count(); ++steps) {
    const std::int32_t way = only_way(robot, pusher_at, puller_at);
    if (way < 0) return way == kSeveral;
    pusher_at = puller_at;
    puller_at = way;
  }
  return false;
}

}  // namespace mrpbench::mapf::lacam
