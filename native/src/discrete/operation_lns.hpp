// Improves operations of all robots by large neighbourhood search on several threads.
#pragma once

#include "operation_search.hpp"

namespace mrpbench::discrete {

/// Rounds are made in a fixed number of lanes, of which threads take their turns. Each lane searches for a while from
/// the same plans. What it finds is taken over in the order of lanes, unless what was taken before excludes it. Thus
/// results do not depend on the number of threads.
class OperationLns {
 public:
  OperationLns(int threads, std::uint64_t seed) : threads_(threads), seed_(seed) {}

  /// Improve the plans of a search. `until`: seconds of a steady clock. `step` keys the draws.
  void improve(const Wishes& wishes, const Budget& budget, double until, std::uint64_t step, OperationSearch& search);

 private:
  struct Change {
    std::vector<std::int32_t> robots;
    std::vector<OperationPlan> plans;
    double most;
  };
  struct Lane {
    OperationSearch search;
    std::vector<Change> changes;
  };
  struct Rounds {
    std::int64_t begin, end;
  };

  void work(const Wishes& wishes, const Budget& budget, double until, std::uint64_t step, Rounds rounds, Lane& lane);
  static bool take(const Wishes& wishes, const Change& change, OperationPlans& plans);
  static void merge(const Wishes& wishes, std::vector<Lane>& lanes);

  std::vector<Lane> lanes_;
  const int threads_;
  const std::uint64_t seed_;
};

double steady_seconds();

}  // namespace mrpbench::discrete
