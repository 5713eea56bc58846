// Proofs that robots can never reach their goals together: no robot gets through a chain if too few vertices are
// empty; on a cycle robots keep their cyclic order; and where there are few arrangements, all reachable ones are tried,
// a robot's move into an empty place or a full cycle's turn at a time, of which all simultaneous moves consist. Where
// following is forbidden no cycle turns, and the parity of a full part with one empty vertex is tested. Pebbles on
// graphs: Kornhauser, Miller and Spirakis, "Coordinating pebble motion on graphs, the diameter of permutation groups,
// and applications", FOCS 1984; with turns of cycles: Yu and Rus, "Pebble motion on graphs with rotations: Efficient
// feasibility tests and planning algorithms", WAFR 2014.
#pragma once

#include <optional>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/instance.hpp"

namespace mrpbench::mapf {

/// A robot that can never be at its goal when all others are at theirs, or nothing, which proves nothing.
/// Not for robots with several goals, ones that disappear, commitments and moves of several ticks. Starts
/// and goals must be distinct.
std::optional<int> find_misplaced_robot(const Instance& instance, Limits& limits);

}  // namespace mrpbench::mapf
