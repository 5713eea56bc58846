// Large neighbourhood search. A first plan by repairing one that has conflicts: Li, Chen, Harabor, Stuckey and Koenig,
// "MAPF-LNS2: Fast repairing for multi-agent path finding via large neighborhood search", AAAI 2022. Then groups of
// robots are replanned until time is over: Li, Chen, Harabor, Stuckey and Koenig, "Anytime multi-agent path
// finding via large neighborhood search", IJCAI 2021.
#pragma once

#include <optional>

#include "mrpbench_mapf/model/objective.hpp"
#include "mrpbench_mapf/model/result.hpp"

namespace mrpbench::mapf {

/// Where the first plan comes from, if every move takes one tick: repairing conflicts; LaCAM; or LaCAM, then repairing
/// for a while, and the cheaper one. Elsewhere LaCAM plans if repairing takes long, unless only repairing is asked for.
enum class Initial { repair, lacam, either };

struct LnsOptions {
  Objective objective = Objective::flowtime;
  Initial initial = Initial::either;
  std::optional<int> neighbourhood;
  std::optional<std::int64_t> iterations;
  std::uint64_t seed = 0;

  static Description<LnsOptions> description() {
    return {
        objective_option<LnsOptions>(),
        {"initial", &LnsOptions::initial,
         Choices<Initial>{{"repair", Initial::repair}, {"lacam", Initial::lacam}, {"either", Initial::either}},
         "Source of the first plan: repair, lacam, or either (lacam, then repair for a while, and the cheaper of the "
         "two "
         "plans); where moves take several ticks, lacam and either repair for a while, then use LaCAM"},
        {"neighbourhood", &LnsOptions::neighbourhood, at_least(1),
         "Number of robots that are replanned at a time; none = 8 while repairing, then 1 to 32, chosen by success"},
        {"iterations", &LnsOptions::iterations, at_least(0),
         "Groups that are replanned, first to repair and again to improve; none = until time is over"},
        {"seed", &LnsOptions::seed, "Seed of all random choices"}};
  }
};

Result solve_lns(const Instance& instance, const LnsOptions& options, Limits& limits);

}  // namespace mrpbench::mapf
