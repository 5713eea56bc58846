// Step by step, every robot goes where those before it leave room: priority inheritance with backtracking.
// Okumura, Machida, Defago and Tamura, "Priority inheritance with backtracking for iterative multi-agent path finding",
// AIJ 2022; the swap operation is that of Okumura, "Improving LaCAM for scalable eventually optimal multi-agent
// pathfinding", IJCAI 2023.
#pragma once

#include "mrpbench_mapf/limits.hpp"

namespace mrpbench::mapf {

struct PibtOptions {
  bool swap = true;
  int steps = 0;  // ticks after which to give up; 0: as many as the roadmap has vertices, times two, plus a thousand
  std::uint64_t seed = 0;
};

/// Needs a roadmap of unit moves, throws std::invalid_argument for any other.
Result solve_pibt(const Instance& instance, const PibtOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
