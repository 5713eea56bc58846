#include "mrpbench_mapf/infeasibility/solvability.hpp"

#include <algorithm>

#include "mrpbench_mapf/infeasibility/rearrangement.hpp"
#include "mrpbench_mapf/model/conflict.hpp"

namespace mrpbench::mapf {

namespace {

/// Tell whether all goals of one robot exclude all goals of another; both robots stay at their goals.
bool goals_clash(const Instance& instance, const Relations& relations, int one, int other) {
  const double reach = instance.reach(one, other);
  for (const int a : instance.robots()[one].goals) {
    for (const int b : instance.robots()[other].goals) {
      if (relations.between(a, b, reach) == Relation::none) return false;
    }
  }
  return true;
}

/// Gives robots distinct goals, one robot after another, by augmenting paths (Berge, "Two theorems in graph theory",
/// PNAS 1957).
class Matching {
 public:
  Matching(const Instance& instance, Limits& limits)
      : instance_(instance),
        limits_(limits),
        owner_(instance.roadmap().vertex_count(), -1),
        asked_by_(instance.roadmap().vertex_count(), -1) {}

  bool place(int robot) { return augment(robot, robot); }

 private:
  bool augment(int robot, int newcomer) {
    for (const int goal : instance_.robots()[robot].goals) {
      limits_.check();
      if (asked_by_[goal] == newcomer) continue;
      asked_by_[goal] = newcomer;
      if (owner_[goal] < 0 || augment(owner_[goal], newcomer)) {
        owner_[goal] = robot;
        return true;
      }
    }
    return false;
  }

  const Instance& instance_;
  Limits& limits_;
  std::vector<int> owner_;     // robot by goal, -1 = free
  std::vector<int> asked_by_;  // the robot for which this goal was last tried
};

/// A robot that gets no goal of its own although it has to stay at one.
std::optional<int> find_missing_goal(const Instance& instance, Limits& limits) {
  if (instance.rules().disappear_at_goal) return std::nullopt;
  Matching matching(instance, limits);
  for (int robot = 0; robot < instance.size(); ++robot) {
    if (!matching.place(robot)) return robot;
  }
  return std::nullopt;
}

/// A robot by which a resource has more users at the start, or for good at the end, than it holds.
std::optional<int> find_crowded(const Instance& instance) {
  for (std::size_t resource = 0; resource < instance.resources().size(); ++resource) {
    const auto inside = [&](int vertex) {
      return std::ranges::count(instance.resources_of(vertex), static_cast<std::int32_t>(resource)) > 0;
    };
    int starting = 0, staying = 0;
    for (int robot = 0; robot < instance.size(); ++robot) {
      const Robot& it = instance.robots()[robot];
      starting += inside(it.start);
      staying += !instance.rules().disappear_at_goal && std::ranges::all_of(it.goals, inside);
      if (std::max(starting, staying) > instance.resources()[resource].capacity) return robot;
    }
  }
  return std::nullopt;
}

/// Of robots with distinct starts. Within a horizon they need not come to their goals.
std::optional<int> find_disagreement(const Instance& instance, Limits& limits) {
  if (instance.rules().horizon != kForever) return std::nullopt;
  if (const auto robot = find_missing_goal(instance, limits)) return robot;
  return find_misplaced_robot(instance, limits);
}

}  // namespace

std::optional<int> find_cut_off_robot(const Instance& instance, DistanceTables& tables, Limits& limits) {
  for (int robot = 0; robot < instance.size(); ++robot) {
    limits.check();
    if (tables[robot](instance.beginning(robot).vertex) == kForever) return robot;
  }
  return std::nullopt;
}

std::optional<int> find_clash(const Instance& instance, const Relations& relations, Limits& limits) {
  const bool stay = !instance.rules().disappear_at_goal && instance.rules().horizon == kForever;
  for (int one = 0; one < instance.size(); ++one) {
    for (int other = 0; other < one; ++other) {
      limits.check();
      const auto &a = instance.beginning(one).occupied, &b = instance.beginning(other).occupied;
      if (find_conflict(instance, relations, one, a, other, b).count > 0) return one;
      if (stay && goals_clash(instance, relations, one, other)) return one;
    }
  }
  if (const auto robot = find_crowded(instance)) return robot;
  return find_disagreement(instance, limits);
}

std::optional<int> find_shared_place(const Instance& instance, Limits& limits) {
  std::vector<char> taken(instance.roadmap().vertex_count(), false);
  for (int robot = 0; robot < instance.size(); ++robot) {
    char& place = taken[instance.robots()[robot].start];
    if (place) return robot;
    place = true;
  }
  return find_disagreement(instance, limits);
}

}  // namespace mrpbench::mapf
