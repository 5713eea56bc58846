#include "mrpbench_mapf/algorithms/astar.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "mrpbench_mapf/infeasibility/solvability.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf {

namespace {

double metres(Heuristic heuristic, const Point& a, const Point& b) {
  const double x = std::abs(a.x - b.x), y = std::abs(a.y - b.y);
  switch (heuristic) {
    case Heuristic::manhattan:
      return x + y;
    case Heuristic::octile:
      return std::max(x, y) + (std::sqrt(2.0) - 1.0) * std::min(x, y);
    default:
      return std::sqrt(x * x + y * y);
  }
}

class Astar {
 public:
  Astar(const Instance& instance, Heuristic heuristic, DistanceTables& tables, Limits& limits, Statistics& statistics)
      : instance_(instance),
        roadmap_(instance.roadmap()),
        heuristic_(heuristic),
        tables_(tables),
        limits_(limits),
        statistics_(statistics) {
    limits.charge(static_cast<std::size_t>(roadmap_.vertex_count()) * sizeof(Node));
    nodes_.resize(roadmap_.vertex_count());
  }

  /// Shortest path of a robot that can reach a goal.
  Path search(int robot) {
    const Beginning& beginning = instance_.beginning(robot);
    begin(robot);
    relax(beginning.vertex, beginning.free_at, -1);
    while (true) {
      limits_.check();
      std::ranges::pop_heap(open_, std::greater{});
      const Open best = open_.back();
      open_.pop_back();
      if (best.g > node(best.vertex).g) continue;
      if (node(best.vertex).goal) return trace(robot, best.vertex);
      ++statistics_.low_level_expansions;
      for (const int edge : roadmap_.out(best.vertex)) {
        if (duration_[edge] > 0) relax(roadmap_.head(edge), best.g + duration_[edge], edge);
      }
    }
  }

 private:
  struct Node {
    Tick g = kForever;
    Tick h = -1;  // -1: not computed yet
    std::int32_t edge = -1;
    std::int32_t robot = -1;  // for which the other values hold
    bool goal = false;
  };
  struct Open {
    Tick f, g;
    std::int32_t vertex;
    bool operator>(const Open& other) const {
      if (f != other.f) return f > other.f;
      if (g != other.g) return g < other.g;
      return vertex > other.vertex;
    }
  };

  void begin(int robot) {
    robot_ = robot;
    open_.clear();
    duration_ = roadmap_.duration(instance_.robots()[robot].profile);
    for (const int goal : instance_.robots()[robot].goals) node(goal).goal = true;
    ticks_per_metre_ = std::numeric_limits<double>::infinity();
    if (heuristic_ == Heuristic::exact || heuristic_ == Heuristic::zero || roadmap_.position().empty()) return;
    for (int edge = 0; edge < roadmap_.edge_count(); ++edge) {
      const Point &a = roadmap_.position()[roadmap_.tail(edge)], &b = roadmap_.position()[roadmap_.head(edge)];
      const double length = metres(heuristic_, a, b);
      if (duration_[edge] > 0 && length > 0) ticks_per_metre_ = std::min(ticks_per_metre_, duration_[edge] / length);
    }
  }

  Node& node(int vertex) {
    Node& it = nodes_[vertex];
    if (it.robot != robot_) it = {.robot = robot_};
    return it;
  }

  Tick estimate(int vertex) {
    if (heuristic_ == Heuristic::exact) return tables_[robot_](vertex);
    if (!std::isfinite(ticks_per_metre_)) return 0;
    double least = std::numeric_limits<double>::infinity();
    for (const int goal : instance_.robots()[robot_].goals) {
      least = std::min(least, metres(heuristic_, roadmap_.position()[vertex], roadmap_.position()[goal]));
    }
    return static_cast<Tick>(std::floor(least * ticks_per_metre_ + 1e-9));
  }

  void relax(int vertex, Tick g, int edge) {
    Node& it = node(vertex);
    if (g >= it.g) return;
    if (it.h < 0) it.h = estimate(vertex);
    if (it.h == kForever) return;
    it.g = g;
    it.edge = edge;
    open_.push_back({g + it.h, g, vertex});
    std::ranges::push_heap(open_, std::greater{});
    ++statistics_.low_level_generated;
  }

  Path trace(int robot, int vertex) {
    Path path = instance_.beginning(robot).occupied;
    const std::size_t known = path.size();
    for (int v = vertex; nodes_[v].edge >= 0; v = roadmap_.tail(nodes_[v].edge)) {
      const Tick arrive = nodes_[v].g, depart = arrive - duration_[nodes_[v].edge];
      path.push_back(at_vertex(v, arrive, arrive));
      path.push_back(on_edge(roadmap_.vertex_count() + nodes_[v].edge, depart, arrive));
    }
    std::reverse(path.begin() + static_cast<std::ptrdiff_t>(known), path.end());
    if (!instance_.rules().disappear_at_goal) path.back().end = kForeverHalf;
    return path;
  }

  const Instance& instance_;
  const Roadmap& roadmap_;
  Heuristic heuristic_;
  DistanceTables& tables_;
  Limits& limits_;
  Statistics& statistics_;
  int robot_ = -1;
  std::span<const Tick> duration_;
  double ticks_per_metre_ = 0;
  std::vector<Node> nodes_;
  std::vector<Open> open_;
};

void solve(const Instance& instance, Heuristic heuristic, Limits& limits, Result& result) {
  DistanceTables tables(instance, limits);
  if (const auto robot = find_cut_off_robot(instance, tables, limits)) return result.no_plan_for(*robot);
  Astar search(instance, heuristic, tables, limits, result.statistics);
  Cost cost = 0;
  for (int robot = 0; robot < instance.size(); ++robot) {
    ++result.statistics.generated;
    result.paths.push_back(search.search(robot));
    ++result.statistics.expansions;
    cost += arrival(result.paths.back());
  }
  result.lower_bound = static_cast<double>(cost);
  result.status = Status::solved;
}

}  // namespace

Result solve_astar(const Instance& instance, const AstarOptions& options, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) { solve(instance, options.heuristic, limits, result); });
}

}  // namespace mrpbench::mapf
