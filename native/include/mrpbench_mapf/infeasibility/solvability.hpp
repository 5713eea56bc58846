// Quick proofs that an instance has no solution at all.
#pragma once

#include <optional>

#include "mrpbench_mapf/model/relations.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf {

/// A robot that cannot reach any of its goals even alone, or nothing.
std::optional<int> find_cut_off_robot(const Instance& instance, DistanceTables& tables, Limits& limits);

/// A robot whose start (or committed beginning) or goals exclude those of another, or nothing. Robots that stay at
/// their goals also need distinct ones, and ways to them all at once (`find_misplaced_robot`). Nor may more start in a
/// resource, or have to stay in it, than it holds.
std::optional<int> find_clash(const Instance& instance, const Relations& relations, Limits& limits);

/// The same where robots exclude one another only at one vertex and nothing is committed.
std::optional<int> find_shared_place(const Instance& instance, Limits& limits);

}  // namespace mrpbench::mapf
