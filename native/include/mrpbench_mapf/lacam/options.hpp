// What can be chosen in LaCAM*.
#pragma once

#include <optional>

#include "mrpbench_mapf/model/objective.hpp"

namespace mrpbench::mapf {

struct LacamOptions {
  Objective objective = Objective::flowtime;
  bool swap = true;
  bool prioritized = true;
  bool guides = true;
  bool star = true;
  bool neighbourhoods = true;
  std::optional<std::int64_t> iterations;
  std::uint64_t seed = 0;

  static Description<LacamOptions> description() {
    return {
        objective_option<LacamOptions>(),
        {"swap", &LacamOptions::swap,
         "Lets robots change places in narrow passages; without it the first plan may take long"},
        {"prioritized", &LacamOptions::prioritized,
         "After the first plan, looks for a cheaper one by planning robots in turn, nearest first"},
        {"guides", &LacamOptions::guides,
         "If that fails, looks for a cheaper plan along guide paths that avoid each other; in a crowd, where there are "
         "none, draws further first plans at random",
         "Okumura, AAMAS 2024"},
        {"star", &LacamOptions::star,
         "After the first plan, continues the search over configurations, where every move takes one tick",
         "Okumura, IJCAI 2023"},
        {"neighbourhoods", &LacamOptions::neighbourhoods,
         "After the first plan, improves it by large neighbourhood search"},
        {"iterations", &LacamOptions::iterations, at_least(0), "Steps of improvement; none = until time is over"},
        {"seed", &LacamOptions::seed, "Seed of all random choices"}};
  }
};

}  // namespace mrpbench::mapf
