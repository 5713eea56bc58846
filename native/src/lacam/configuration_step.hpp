// From one configuration to the next by priority inheritance with backtracking (PIBT): Okumura, Machida, Defago and
// Tamura, "Priority inheritance with backtracking for iterative multi-agent path finding", AIJ 2022; with the swap
// operation of Okumura, "Improving LaCAM for scalable eventually optimal multi-agent pathfinding", IJCAI 2023.
#pragma once

#include <cstdint>
#include <vector>

#include "lacam/guide_paths.hpp"
#include "lacam/moves.hpp"
#include "mrpbench_mapf/common/random.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf::lacam {

class ConfigurationStep {
 public:
  ConfigurationStep(const Instance& instance, const Moves& moves, DistanceTables& tables, const GuidePaths* guides,
                    bool swap, std::uint64_t seed, Limits& limits);

  /// Where all robots go from `from`: robot r to `to[r]` if that is no -1, the others where PIBT sends them, those
  /// first in `order` before the others. False if it finds no way for all; then `to` means nothing.
  bool operator()(const std::int32_t* from, const std::int32_t* order, std::int32_t* to);

  /// From now on all robots go straight to their goals.
  void drop_guide_paths() { guide_paths_ = nullptr; }

 private:
  static constexpr int kDeepest = 10'000;  // robots in one chain of inheritance, for the stack's sake
  struct Candidate {
    std::uint32_t key;
    std::int32_t vertex;
  };

  static constexpr std::int32_t kNone = -1, kSeveral = -2;

  bool reserve_fixed();
  bool move(int robot, int depth);
  int rank(int robot, Candidate* candidates);
  int swap_partner(int robot, int wanted);
  std::int32_t only_way(int before, int here) const;
  bool must_swap(int pusher, int puller, int pusher_at, int puller_at);
  bool can_swap(int pusher_at, int puller_at) const;
  void settle(int robot, int vertex) {
    to_[robot] = vertex;
    next_[vertex] = robot;
  }

  const Moves& moves_;
  int robots_;
  const GuidePaths* guide_paths_;
  bool swap_;
  Random random_;
  std::vector<DistanceTable*> distance_;
  std::vector<std::int32_t> goal_;
  int most_candidates_ = 0;
  std::vector<Candidate> candidates_;     // a row of `most_candidates_` for each robot
  std::vector<std::int32_t> now_, next_;  // robot by vertex, -1 = none
  const std::int32_t* from_ = nullptr;    // of the current step
  std::int32_t* to_ = nullptr;
};

}  // namespace mrpbench::mapf::lacam
