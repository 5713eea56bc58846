// Step by step, every robot goes where those before it leave room: priority inheritance with backtracking.
// Okumura, Machida, Defago and Tamura, "Priority inheritance with backtracking for iterative multi-agent path finding",
// AIJ 2022; the swap operation is that of Okumura, "Improving LaCAM for scalable eventually optimal multi-agent
// pathfinding", IJCAI 2023.
#pragma once

#include "mrpbench_mapf/model/result.hpp"
#include "mrpbench_options/options.hpp"

namespace mrpbench::mapf {

struct PibtOptions {
  bool swap = true;
  int steps = 0;
  std::uint64_t seed = 0;

  static Description<PibtOptions> description() {
    return {{"swap", &PibtOptions::swap, "Lets robots change places in narrow passages, but not within a window",
             "Okumura, IJCAI 2023"},
            {"steps", &PibtOptions::steps, at_least(0),
             "Steps after which the planner gives up; 0 = twice the number of vertices of the roadmap, plus 1000"},
            {"seed", &PibtOptions::seed, "Seed of the choice between equally good vertices"}};
  }
};

/// Needs robots with one goal each, where they stay; throws std::invalid_argument for others.
Result solve_pibt(const Instance& instance, const PibtOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
