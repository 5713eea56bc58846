// Every robot plans alone and ignores the others.
// Hart, Nilsson and Raphael, "A Formal Basis for the Heuristic Determination of Minimum Cost Paths", IEEE TSSC 1968.
#pragma once

#include "mrpbench_mapf/limits.hpp"

namespace mrpbench::mapf {

/// Geometric heuristics are distances in metres times the least ticks per metre of any edge, hence consistent.
enum class Heuristic { exact, zero, manhattan, octile, euclidean };

/// Shortest paths; they may conflict. The lower bound is their cost, since no robot can do better among others.
Result solve_astar(const Instance& instance, Heuristic heuristic, Limits& limits);

}  // namespace mrpbench::mapf
