// From one configuration to the next by priority inheritance with backtracking (PIBT), where every move takes one tick
// and robots exclude one another only at one vertex: Okumura, Machida, Defago and Tamura, "Priority inheritance with
// backtracking for iterative multi-agent path finding", AIJ 2022.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lacam/configuration_generator.hpp"
#include "lacam/guide_paths.hpp"
#include "lacam/swap.hpp"
#include "mrpbench_mapf/common/random.hpp"

namespace mrpbench::mapf::lacam {

class ConfigurationStep final : public ConfigurationGenerator {
 public:
  ConfigurationStep(const Instance& instance, const Moves& moves, DistanceTables& tables, const GuidePaths* guides,
                    bool swap, std::uint64_t seed, Limits& limits);

  bool operator()(const std::int32_t* from, const std::int32_t* order, std::int32_t* to) override;
  void drop_guide_paths() override { guide_paths_ = nullptr; }

 private:
  static constexpr int kDeepest = 10'000;  // robots in one chain of inheritance, for the stack's sake
  struct Candidate {
    std::uint32_t key;
    std::int32_t vertex;
  };

  bool reserve_fixed();
  bool move(int robot, int depth);
  int rank(int robot, Candidate* candidates);
  void settle(int robot, int vertex) {
    to_[robot] = vertex;
    next_[vertex] = robot;
  }

  const Moves& moves_;
  int robots_;
  const GuidePaths* guide_paths_;
  std::optional<Swap> swap_;
  Random random_;
  std::vector<DistanceTable*> distance_;
  int most_candidates_;
  std::vector<Candidate> candidates_;     // a row of `most_candidates_` for each robot
  std::vector<std::int32_t> now_, next_;  // robot by vertex, -1 = none
  const std::int32_t* from_ = nullptr;    // of the current step
  std::int32_t* to_ = nullptr;
};

}  // namespace mrpbench::mapf::lacam
