// An instance as a search over configurations sees it: the start, the successors of a configuration, and the plan that
// a sequence of configurations stands for.
#pragma once

#include <memory>
#include <optional>

#include "lacam/configuration_generator.hpp"
#include "lacam/guide_paths.hpp"
#include "lacam/joint_moves.hpp"

namespace mrpbench::mapf::lacam {

class ConfigurationSpace {
 public:
  /// For instances that are `suitable`.
  ConfigurationSpace(const Instance& instance, Limits& limits);

  const Moves& moves() const { return moves_; }
  /// Every move takes one tick, and robots exclude one another only at one vertex: a step takes a tick.
  bool is_unit() const { return !relations_; }
  /// Where there is a plan, there is a sequence of configurations. False also if robots would block one another once
  /// they have done what they are committed to.
  bool misses_no_plan() const;
  /// Where robots are free to go; nothing if not all can be there at one time, or if one of them would be in the way of
  /// what another one is committed to until it goes.
  std::optional<std::vector<std::int32_t>> start();
  std::unique_ptr<ConfigurationGenerator> generator(DistanceTables& tables, const GuidePaths* guides, bool swap,
                                                    std::uint64_t seed, Limits& limits);
  /// Steps after which no robot moves before `horizon`.
  int steps_within(Tick horizon) const;
  std::vector<Path> paths_of(const std::vector<Configuration>& sequence);
  /// Set `result` to unsolvable if that is soon proved; else set the lower bound.
  bool prove_unsolvable(DistanceTables& tables, Limits& limits, Result& result) const;

 private:
  std::vector<Path> unit_paths_of(const std::vector<Configuration>& sequence) const;
  /// Tell whether all robots can complete their commitments and then stay.
  bool beginnings_agree() const;

  const Instance& instance_;
  Limits& limits_;
  Moves moves_;
  std::optional<Relations> relations_;  // none where all is unit
  std::optional<JointMoves> joint_;
};

/// Tell whether every robot has one goal and stays there.
bool is_suitable(const Instance& instance);
/// Throws std::invalid_argument naming the `solver` that can do nothing with an instance that is not.
void require_suitable(const Instance& instance, const char* solver);

}  // namespace mrpbench::mapf::lacam
