// From one configuration to the next by priority inheritance with backtracking (Okumura et al., AIJ 2022) where moves
// take several ticks and robots have footprints or use resources. A robot displaces all those that its move excludes;
// they go first, or with it. Which moves exclude one another beyond a shared vertex is the concern of Li et al.,
// "Multi-agent path finding for large agents", AAAI 2019.
#pragma once

#include <optional>

#include "lacam/configuration_generator.hpp"
#include "lacam/joint_moves.hpp"
#include "lacam/swap.hpp"
#include "mrpbench_mapf/common/random.hpp"

namespace mrpbench::mapf::lacam {

class TimedStep final : public ConfigurationGenerator {
 public:
  TimedStep(const Instance& instance, const Moves& moves, JointMoves& joint, DistanceTables& tables, bool swap,
            std::uint64_t seed);

  bool operator()(const std::int32_t* from, const std::int32_t* order, std::int32_t* to) override;

 private:
  static constexpr int kDeepest = 10'000;  // robots in one chain of inheritance, for the stack's sake
  struct Candidate {
    std::uint64_t key;
    std::int32_t vertex;
  };

  bool settle_fixed();
  bool move(int robot, int depth);
  std::vector<Candidate> rank(int robot);
  bool fits(const Move& move, std::vector<int>& displaced) const;
  bool fits_beside(const Move& move, int other) const;
  bool fits_roomy(const Move& move, std::vector<int>& displaced) const;
  bool displace(const Move& move, const std::vector<int>& displaced, int depth);
  Move move_of(int robot) const { return joint_.move(robot, from_[robot], to_[robot]); }
  void settle(const Move& move);
  void unsettle(const Move& move);

  const Instance& instance_;
  const Moves& moves_;
  JointMoves& joint_;
  std::optional<Swap> swap_;
  Random random_;
  std::vector<DistanceTable*> distance_;
  std::vector<std::int32_t> now_;      // robot by vertex, -1 = none
  std::vector<std::int32_t> claimed_;  // robot that moves on or to an element, -1 = none
  std::vector<bool> displacing_;       // by robot: waits until those that it displaces have found a place
  std::vector<std::vector<Move>> rounds_;
  const std::int32_t* from_ = nullptr;  // of the current step
  std::int32_t* to_ = nullptr;
};

}  // namespace mrpbench::mapf::lacam
