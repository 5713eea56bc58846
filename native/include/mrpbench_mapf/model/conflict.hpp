// Conflicts between two timed paths: one sweep over both, since the occupations of a path follow one another without a
// gap from tick 0 on. Where robots may be late (`Rules::k`), occupations that are not farther apart conflict as well.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_mapf/model/relations.hpp"

namespace mrpbench::mapf {

/// Tell whether, of two robots on one lane at the same time, the first to enter is not the first to leave. That robots
/// are late changes no order: at both ends of the lane they stand farther apart than they may be late.
inline bool overtakes(const Occupation& one, const Occupation& other) {
  return (one.begin < other.begin) != (one.end < other.end) || one.begin == other.begin || one.end == other.end;
}

/// Leave out what begins after the horizon. A stay ends with it, so that it is in nobody's way later.
void limit(const Instance& instance, std::vector<Occupation>& path);

/// Two robots in one another's way. `count` conflicts in all, described is the earliest.
struct PairConflict {
  std::int32_t one, other;            // robots
  std::int32_t one_step, other_step;  // indices into their paths
  Half time;
  Relation relation;
  std::int32_t count;  // 0: none
};

PairConflict find_conflict(const Instance& instance, const Relations& relations, int one,
                           std::span<const Occupation> one_path, int other, std::span<const Occupation> other_path);

}  // namespace mrpbench::mapf
