// Improves a plan by large neighbourhood search until that brings nothing any more, then begins again with another
// first plan by LaCAM: local search from many starts, as surveyed by Martí, Resende and Ribeiro, "Multi-start methods
// for combinatorial optimization", EJOR 2013. Where moves take several ticks, a first plan is soon found, and decides
// which plans the neighbourhoods lead to.
#pragma once

#include "lacam/lacam_search.hpp"
#include "lns/improvement.hpp"

namespace mrpbench::mapf {

class MultiStart {
 public:
  /// `schedule` holds a plan without conflicts from when `advance` is first called.
  MultiStart(lacam::ConfigurationSpace& space, DistanceTables& tables, lns::Schedule& schedule,
             const LacamOptions& options);

  /// Take a step. True if the plan in the schedule is the best so far.
  bool advance();

 private:
  static constexpr int kIdle = 50;        // steps that bring nothing
  static constexpr int kPatience = 5000;  // steps of a search for another first plan

  bool search();
  bool is_best();

  lacam::ConfigurationSpace& space_;
  DistanceTables& tables_;
  lns::Schedule& schedule_;
  LacamOptions options_;
  lns::Improvement improvement_;
  Limits limits_;  // of one search for a first plan, whose memory is free afterwards
  Statistics statistics_;
  std::optional<lacam::LacamSearch> search_;  // while there is one
  int idle_ = 0, steps_ = 0;
  std::optional<Value> best_;
};

}  // namespace mrpbench::mapf
