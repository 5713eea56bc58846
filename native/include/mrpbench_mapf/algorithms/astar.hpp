// Every robot plans alone and ignores the others.
// Hart, Nilsson and Raphael, "A Formal Basis for the Heuristic Determination of Minimum Cost Paths", IEEE TSSC 1968.
#pragma once

#include "mrpbench_mapf/model/result.hpp"
#include "mrpbench_options/options.hpp"

namespace mrpbench::mapf {

/// Geometric heuristics are distances in metres times the least ticks per metre of any edge, hence consistent.
enum class Heuristic { exact, zero, manhattan, octile, euclidean };

struct AstarOptions {
  Heuristic heuristic = Heuristic::exact;

  static Description<AstarOptions> description() {
    return {
        {"heuristic", &AstarOptions::heuristic,
         Choices<Heuristic>{{"exact", Heuristic::exact},
                            {"zero", Heuristic::zero},
                            {"manhattan", Heuristic::manhattan},
                            {"octile", Heuristic::octile},
                            {"euclidean", Heuristic::euclidean}},
         "Estimate of the ticks to go: exact (true distances), zero, or a distance in metres times the least ticks per "
         "metre of any edge: manhattan, octile, euclidean. All find shortest paths, with different effort"}};
  }
};

/// Shortest paths; they may conflict. The lower bound is their cost, since no robot can do better among others.
Result solve_astar(const Instance& instance, const AstarOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
