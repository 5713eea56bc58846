// Improves an order in which all decisions are made by switching one decision after another.
//
// The neighbourhood of van Laarhoven, Aarts and Lenstra, "Job shop scheduling by simulated annealing", Operations
// Research 40 (1992): robots can only arrive earlier if a decision is switched that some robot waits for. With it are
// switched those that it implies. The first switch that lets robots arrive earlier in sum is kept.
#pragma once

#include <cstdint>
#include <vector>

#include "reordering/earliest.hpp"

namespace mrpbench::mapf {

class LocalSearch {
 public:
  /// `sides` by decision must form no cycle with the fixed arcs.
  LocalSearch(const AlternativeGraph& graph, const Decisions& decisions, const ArcIndex& arcs, std::vector<Side> sides,
              Limits& limits);

  /// Switch decisions until no single switch helps or so much `work` is done. Where `Limits` ends it, the order is the
  /// last one that was kept.
  void run(std::int64_t work);
  Cost cost() const { return cost_; }
  std::int64_t work() const { return times_.work(); }
  const std::vector<Side>& sides() const { return sides_; }

 private:
  struct Wait {
    Tick ticks;
    std::int32_t decision;
  };

  std::vector<Wait> waits() const;
  bool improves(std::int32_t decision);
  bool switched();
  Tick longest_wait(Choice choice) const;

  const Decisions& decisions_;
  const ArcIndex& arcs_;
  EarliestTimes times_;
  std::vector<Side> sides_;
  Cost cost_;
  std::vector<Choice> chosen_;          // the choices that a switch makes
  std::vector<std::int32_t> round_of_;  // by decision: the last switch that made a choice of it
  std::int32_t round_ = 0;
};

}  // namespace mrpbench::mapf
