#include "mrpbench_mapf/infeasibility/rearrangement.hpp"

#include <algorithm>
#include <utility>

#include "mrpbench_mapf/infeasibility/chains.hpp"

namespace mrpbench::mapf {

namespace {

bool applies(const Instance& instance) {
  if (instance.rules().disappear_at_goal) return false;
  const auto plain = [](const Robot& robot) { return robot.goals.size() == 1 && robot.committed.empty(); };
  if (!std::ranges::all_of(instance.robots(), plain)) return false;
  for (int profile = 0; profile < instance.roadmap().profile_count(); ++profile) {
    if (std::ranges::any_of(instance.roadmap().duration(profile), [](Tick ticks) { return ticks > 1; })) return false;
  }
  return true;
}

/// A connected part of the roadmap, disregarding the direction of edges, and the robots that start in it.
struct Part {
  std::vector<int> vertices;
  std::vector<int> robots;
};

/// All vertices connected with `vertex`, of which none has a number in `part_of` (-1 = none) yet; they get `number`.
std::vector<int> gather_part(const Roadmap& roadmap, int vertex, int number, std::vector<int>& part_of) {
  std::vector<int> part;
  const auto reach = [&](int at) {
    if (part_of[at] < 0) part.push_back(at);
    part_of[at] = number;
  };
  reach(vertex);
  for (std::size_t next = 0; next < part.size(); ++next) {
    const int at = part[next];
    for (const int edge : roadmap.out(at)) reach(roadmap.head(edge));
    for (const int edge : roadmap.in(at)) reach(roadmap.tail(edge));
  }
  return part;
}

/// The vertices of a part that is a cycle, one after another; empty if it is none.
std::vector<int> line_up(const Roadmap& roadmap, const std::vector<int>& part) {
  for (const int vertex : part) {
    if (roadmap.neighbours(vertex).size() != 2) return {};
  }
  std::vector<int> line{part.front()};
  while (line.size() < part.size()) {
    const int before = line.size() > 1 ? line[line.size() - 2] : -1;
    const std::vector<int> next = roadmap.neighbours(line.back());
    line.push_back(next.front() == before ? next.back() : next.front());
  }
  return line;
}

/// The robot at which the order of the goals along a cycle first differs from that of the starts, -1 = it does not
/// differ. All rotations of a cycle are one order.
int find_disorder(const Instance& instance, const std::vector<int>& cycle) {
  std::vector<int> robot_at(instance.roadmap().vertex_count(), -1), place(instance.roadmap().vertex_count());
  for (std::size_t k = 0; k < cycle.size(); ++k) place[cycle[k]] = static_cast<int>(k);
  for (int robot = 0; robot < instance.size(); ++robot) robot_at[instance.robots()[robot].start] = robot;
  int previous = -1, first = -1, turns = 0;
  for (const int vertex : cycle) {
    if (robot_at[vertex] < 0) continue;
    const int goal = place[instance.robots()[robot_at[vertex]].goals.front()];
    if (previous >= 0 && goal < previous && ++turns > 1) return robot_at[vertex];
    previous = goal;
    if (first < 0) first = goal;
  }
  if (turns == 0 || previous < first) return -1;
  return robot_at[*std::ranges::find_if(cycle, [&](int vertex) { return robot_at[vertex] >= 0; })];
}

bool is_moved(const Instance& instance, const Part& part) {
  return std::ranges::any_of(
      part.robots, [&](int robot) { return instance.robots()[robot].start != instance.robots()[robot].goals.front(); });
}

/// With a single empty vertex, every move is an exchange of it with a robot, so that the parity of the arrangement
/// follows from where it is, if neighbours always differ in colour (Wilson, "Graph puzzles, homotopy, and the
/// alternating group", JCTB 1974). Where following is forbidden, there are no other moves.
bool has_wrong_parity(const Instance& instance, const Part& part) {
  std::vector<int> colour(instance.roadmap().vertex_count(), -1), robot_at(colour), goal_of(colour);
  colour[part.vertices.front()] = 0;
  for (const int vertex : part.vertices) {  // each was found from one before it
    for (const int next : instance.roadmap().neighbours(vertex)) {
      if (colour[next] == colour[vertex]) return false;
      colour[next] = 1 - colour[vertex];
    }
  }
  for (const int robot : part.robots) {
    const Robot& it = instance.robots()[robot];
    goal_of[it.start] = it.goals.front();
    robot_at[it.goals.front()] = robot;
  }
  const auto is_free = [](const std::vector<int>& of) { return [&of](int vertex) { return of[vertex] < 0; }; };
  const int before = *std::ranges::find_if(part.vertices, is_free(goal_of));
  const int after = *std::ranges::find_if(part.vertices, is_free(robot_at));
  goal_of[before] = after;
  bool odd = false;
  for (const int vertex : part.vertices) {
    for (int next = std::exchange(goal_of[vertex], -1); next >= 0 && next != vertex;) {
      odd = !odd;
      next = std::exchange(goal_of[next], -1);
    }
  }
  return odd != (colour[before] != colour[after]);
}

/// All reachable arrangements of robots on a few vertices.
class Arrangements {
 public:
  static constexpr std::int64_t kMost = 20'000;

  Arrangements(const Instance& instance, const Part& part, Limits& limits)
      : instance_(instance), part_(part), limits_(limits), place_(instance.roadmap().vertex_count(), -1) {
    for (std::size_t k = 0; k < part.vertices.size(); ++k) place_[part.vertices[k]] = static_cast<int>(k);
  }

  static bool are_few(const Part& part) {
    auto left = static_cast<std::int64_t>(part.vertices.size());
    std::int64_t number = 1;
    for (std::size_t k = 0; k < part.robots.size() && number <= kMost; ++k) number *= left--;
    return number <= kMost;
  }

  bool can_reach_goals() {
    const std::size_t robots = part_.robots.size();
    std::vector<int> at(robots), goal(robots);
    for (std::size_t k = 0; k < robots; ++k) {
      at[k] = place_[instance_.robots()[part_.robots[k]].start];
      goal[k] = place_[instance_.robots()[part_.robots[k]].goals.front()];
    }
    std::int64_t all = 1;
    for (std::size_t k = 0; k < robots; ++k) all *= static_cast<std::int64_t>(part_.vertices.size());
    limits_.charge(static_cast<std::size_t>(all / 8 + kMost * static_cast<std::int64_t>(sizeof(std::int64_t))));
    seen_.assign(all, false);
    see(at);
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      limits_.check();
      read(queue_[next], at);
      if (at == goal) return true;
      robot_at_.assign(part_.vertices.size(), -1);
      for (std::size_t k = 0; k < robots; ++k) robot_at_[at[k]] = static_cast<int>(k);
      for (std::size_t k = 0; k < robots; ++k) {
        chain_.assign(1, static_cast<int>(k));
        extend(at);
      }
    }
    return false;
  }

 private:
  /// The last robot of the chain goes to an empty place, or the chain is closed and turns, or it becomes longer.
  void extend(std::vector<int>& at) {
    const int robot = chain_.back();
    const int vertex = part_.vertices[at[robot]];
    const std::span<const Tick> duration =
        instance_.roadmap().duration(instance_.robots()[part_.robots[robot]].profile);
    for (const int edge : instance_.roadmap().out(vertex)) {
      if (duration[edge] < 0) continue;
      const int to = place_[instance_.roadmap().head(edge)];
      const int there = robot_at_[to];
      if (there < 0 && chain_.size() == 1) {
        const int from = std::exchange(at[robot], to);
        see(at);
        at[robot] = from;
      } else if (there == chain_.front() && chain_.size() > 2) {
        if (!instance_.rules().following_forbidden) turn(at);
      } else if (there > chain_.front() && std::ranges::find(chain_, there) == chain_.end()) {
        chain_.push_back(there);  // a cycle is begun at its least robot only
        extend(at);
        chain_.pop_back();
      }
    }
  }

  void turn(const std::vector<int>& at) {
    std::vector<int> turned = at;
    for (std::size_t k = 0; k < chain_.size(); ++k) turned[chain_[k]] = at[chain_[(k + 1) % chain_.size()]];
    see(turned);
  }

  void see(const std::vector<int>& at) {
    std::int64_t key = 0;
    for (const int place : at) key = key * static_cast<std::int64_t>(part_.vertices.size()) + place;
    if (seen_[key]) return;
    seen_[key] = true;
    queue_.push_back(key);
  }
  void read(std::int64_t key, std::vector<int>& at) const {
    for (std::size_t k = at.size(); k-- > 0; key /= static_cast<std::int64_t>(part_.vertices.size())) {
      at[k] = static_cast<int>(key % static_cast<std::int64_t>(part_.vertices.size()));
    }
  }

  const Instance& instance_;
  const Part& part_;
  Limits& limits_;
  std::vector<int> place_;  // by vertex of the roadmap: its number in the part
  std::vector<bool> seen_;  // by key: the places of all robots as digits
  std::vector<std::int64_t> queue_;
  std::vector<int> robot_at_, chain_;
};

}  // namespace

std::optional<int> find_misplaced_robot(const Instance& instance, Limits& limits) {
  if (instance.size() < 2 || !applies(instance)) return std::nullopt;
  std::vector<int> part_of(instance.roadmap().vertex_count(), -1);
  std::vector<Part> all;
  for (int robot = 0; robot < instance.size(); ++robot) {
    const int start = instance.robots()[robot].start;
    limits.check();
    if (part_of[start] < 0) {
      all.push_back({gather_part(instance.roadmap(), start, static_cast<int>(all.size()), part_of), {}});
    }
    if (part_of[instance.robots()[robot].goals.front()] != part_of[start]) return robot;
    all[part_of[start]].robots.push_back(robot);
  }
  for (const Part& part : all) {
    if (part.robots.size() < 2) continue;
    const std::size_t empty = part.vertices.size() - part.robots.size();
    const auto is_thin = [&](int vertex) { return instance.roadmap().out(vertex).size() <= 2; };
    if (empty <= 2 + static_cast<std::size_t>(std::ranges::count_if(part.vertices, is_thin))) {
      if (const auto robot = find_robot_beyond_chain(instance, part.vertices, part.robots, limits)) return robot;
    }
    if (const std::vector<int> cycle = line_up(instance.roadmap(), part.vertices); !cycle.empty()) {
      const int robot = find_disorder(instance, cycle);
      if (robot >= 0) return robot;
    }
    if (instance.rules().following_forbidden && empty < 2) {
      if (empty == 1 ? has_wrong_parity(instance, part) : is_moved(instance, part)) return part.robots.front();
    }
    if (Arrangements::are_few(part) && !Arrangements(instance, part, limits).can_reach_goals()) {
      return part.robots.front();
    }
  }
  return std::nullopt;
}

}  // namespace mrpbench::mapf
